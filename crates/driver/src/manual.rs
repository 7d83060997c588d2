//! Completions and man pages, made from the commands and flags themselves.

use crate::flags::Cli;
use clap::CommandFactory;
use clap_complete::Shell;
use std::path::{Path, PathBuf};
use vaso_driver::DriverError;

/// The script that completes `vaso` in a shell.
pub(crate) fn completions(shell: Shell) -> String {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "vaso", &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

/// Writes `vaso.1` and a page for each command, and tells which.
pub(crate) fn write(folder: &Path) -> Result<Vec<PathBuf>, DriverError> {
    let wrong = |e: std::io::Error| {
        DriverError::input(format!(
            "{}: the manual cannot be written there: {e}; name another folder",
            folder.display()
        ))
    };
    std::fs::create_dir_all(folder).map_err(wrong)?;
    let program = Cli::command().disable_help_subcommand(true);
    let commands = program.get_subcommands().map(|command| format!("vaso-{}.1", command.get_name()));
    let pages = std::iter::once("vaso.1".to_owned()).chain(commands).map(|page| folder.join(page)).collect();
    clap_mangen::generate_to(program, folder).map_err(wrong)?;
    Ok(pages)
}
