//! Prints the reference of `case.toml`.

fn main() {
    print!("{}", vaso_scene::case_reference());
}
