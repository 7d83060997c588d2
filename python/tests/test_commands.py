"""Running the program: what is handed to it, what it refuses, and being stopped."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import COARSE, PIPE

import vaso

#: Long enough to be stopped on the way.
LONG = {**COARSE, "run.end_time": "1 s"}


def test_check_tells_what_the_program_tells() -> None:
    report = vaso.check(PIPE, particles__spacing="1 mm")
    assert report["numbers"]["reynolds_peak"] == pytest.approx(100.0, rel=2e-3)
    # A particle a cubic spacing.
    assert report["predicted"]["particles"]["fluid"] == pytest.approx(report["surface"]["volume_m3"] / 1e-9, rel=0.02)
    bare = vaso.check(PIPE / "pipe.stl", unit="mm")
    assert [opening["area_m2"] for opening in bare["openings"]] == pytest.approx([np.pi * 3.175e-3**2] * 2, rel=2e-3)


def test_overrides_reach_the_case_in_either_spelling() -> None:
    thinner = vaso.check(PIPE, blood__viscosity="1.8 mPa s")
    slower = vaso.check(PIPE, **{"opening.inlet.value": "26.996625 mm/s"})
    assert thinner["numbers"]["reynolds_peak"] == pytest.approx(200.0, rel=2e-3)
    assert slower["numbers"]["reynolds_peak"] == pytest.approx(50.0, rel=2e-3)
    fields = vaso.check(PIPE, output__fields=["velocity", "wss"], numerics__allow_mach=True, numerics__seed=np.int64(3))
    shear = next(effect for effect in fields["effects"] if effect["name"] == "metrics.wall_shear")
    assert shear["on"]
    with pytest.raises(TypeError, match="check\\(\\) has no argument `spacing`"):
        vaso.check(PIPE, spacing="1 mm")


def test_what_the_program_refuses_is_raised_in_its_words(pipe: vaso.Result, tmp_path: Path) -> None:
    with pytest.raises(vaso.InputError, match="did you mean `spacing`") as refused:
        vaso.run(PIPE, out=tmp_path / "out", particles__spacin="1 mm")
    assert refused.value.code == 2 and not (tmp_path / "out").exists()
    with pytest.raises(vaso.InputError, match="cannot be read"):
        vaso.check(tmp_path / "nowhere")
    with pytest.raises(vaso.InputError, match="finished run"):
        vaso.run(PIPE, out=pipe.out, **COARSE)


def test_package_and_program_are_of_one_version(program: Path) -> None:
    told = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    assert told.split() == ["vaso", vaso.__version__]


def test_a_case_is_made_from_a_surface(tmp_path: Path) -> None:
    made = vaso.new(tmp_path / "case", PIPE / "pipe.stl", unit="mm")
    assert made["unit"] == "mm" and not made["unit_guessed"] and len(made["check"]["openings"]) == 2
    assert "ASSUMED" in (tmp_path / "case" / "case.toml").read_text()
    assert vaso.check(tmp_path / "case")["surface"]["watertight"]


def test_the_program_is_looked_for_where_it_is_said_to_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, program: Path
) -> None:
    assert vaso.find_binary(program) == program.resolve()
    monkeypatch.setenv("VASO_BIN", str(tmp_path / "vaso"))
    with pytest.raises(vaso.BinaryNotFound, match="VASO_BIN names .* not a program"):
        vaso.find_binary()
    monkeypatch.delenv("VASO_BIN")
    folder = tmp_path / "bin"
    folder.mkdir()
    (folder / "vaso").symlink_to(program)
    monkeypatch.setenv("PATH", str(folder))
    assert vaso.find_binary() == folder / "vaso"
    built = tmp_path / "checkout" / "target" / "release" / "vaso"
    built.parent.mkdir(parents=True)
    (tmp_path / "checkout" / "crates" / "driver").mkdir(parents=True)
    built.symlink_to(program)
    monkeypatch.setenv("PATH", "")
    monkeypatch.chdir(tmp_path / "checkout" / "crates")
    assert vaso.find_binary() == built


def wait_for(path: Path, process: subprocess.Popen[bytes]) -> None:
    """Until a file is there."""
    end = time.monotonic() + 60
    while not path.exists():
        assert process.poll() is None and time.monotonic() < end, f"{path.name} did not come"
        time.sleep(0.02)


def test_a_killed_run_can_be_read_and_gone_on_with(tmp_path: Path) -> None:
    out = tmp_path / "out"
    settings = [f"--set={key}={value}" for key, value in LONG.items() if isinstance(value, str)]
    command = [str(vaso.find_binary()), "run", str(PIPE), "--out", str(out), "--threads", "1", "--quiet", *settings]
    process = subprocess.Popen([*command, "--set=output.checkpoint_every=20 ms"])
    wait_for(out / "fluid.vtkhdf", process)
    running = vaso.Result(out)
    while len(running.fluid) < 4:
        time.sleep(0.01)
    assert running.summary["status"] == "running"
    process.kill()
    process.wait()

    killed = vaso.Result(out)
    frames = len(killed.fluid)
    assert killed.summary["status"] == "running" and 4 <= frames < 51
    assert np.isfinite(killed.particles()["Velocity"]).all()
    assert killed.openings["time_s"][-1] >= killed.fluid.times[2]

    resumed = vaso.resume(out, threads=1)
    assert resumed.summary["status"] == "completed" and len(resumed.fluid) == 51
    # The same run, so frames from before the kill are the same ones.
    assert resumed.fluid.times[: frames - 1] == pytest.approx(killed.fluid.times[: frames - 1], abs=0.0)


def test_ctrl_c_leaves_a_checkpoint_behind(tmp_path: Path) -> None:
    out = tmp_path / "out"
    script = f"import vaso; vaso.run({str(PIPE)!r}, out={str(out)!r}, threads=1, **{LONG!r})"
    # Where the tests run in the background of a script, Ctrl-C is ignored, and what they start ignores it, too.
    heed = lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)  # noqa: E731
    process = subprocess.Popen([sys.executable, "-c", script], stderr=subprocess.PIPE, preexec_fn=heed)
    wait_for(out / "fluid.vtkhdf", process)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert b"KeyboardInterrupt" in said and process.returncode != 0
    stopped = vaso.Result(out)
    assert stopped.summary["status"] == "interrupted" and stopped.summary["time_s"] < 1.0
    assert (out / "checkpoint.h5").is_file()


@pytest.mark.skipif(os.name == "nt", reason="a program to stand for vaso is a shell script")
def test_exit_codes_are_exceptions(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    stand_in = tmp_path / "vaso"
    for code, kind in [(1, vaso.RunError), (2, vaso.InputError), (130, vaso.Interrupted), (77, vaso.VasoError)]:
        stand_in.write_text(f"#!/bin/sh\necho 'warning  before'>&2; echo 'error: what\n  advice  why'>&2; exit {code}\n")
        stand_in.chmod(0o755)
        with pytest.raises(vaso.VasoError) as raised:
            vaso.execute(["run", "case"], binary=stand_in)
        assert type(raised.value) is kind and raised.value.code == code
        assert raised.value.message == "what\n  advice  why"
    stand_in.write_text("#!/bin/sh\nkill -TERM $$\n")
    with pytest.raises(vaso.Interrupted, match="signal 15"):
        vaso.execute(["run", "case"], binary=stand_in)
    stand_in.write_text("#!/bin/sh\necho no JSON\n")
    with pytest.raises(vaso.RunError, match="no JSON"):
        vaso.check("case", binary=stand_in)
    stand_in.write_text("#!/bin/sh\necho 1 of 2 s >&2\n")
    assert vaso.execute(["run", "case"], binary=stand_in) == "" and capsys.readouterr().err == ""
    vaso.execute(["run", "case"], binary=stand_in, quiet=False)
    assert capsys.readouterr().err == "1 of 2 s\n"
