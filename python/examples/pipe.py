# %% [markdown]
# # Blood in a pipe, against Poiseuille's formula
#
# Cells begin with `# %%`: editors such as VS Code, Spyder and PyCharm run them one by one, and `python examples/pipe.py` all of them.
# Some ten seconds on one core. Pictures and results go to the folder `pipe` in the working folder.

# %%
from pathlib import Path

import numpy as np

import vaso

case = Path(__file__).resolve().parents[2] / "cases" / "pipe"
folder = Path("pipe")

# %% [markdown]
# The case has sixteen particles across the pipe. Ten are enough here, and overrides say so without a word in the file. What
# would run is told first: the audit of the surface, the openings, the cost.

# %%
overrides = {
    "particles.spacing": "0.635 mm",
    "run.end_time": "1 s",
    "output.fields": ["velocity", "pressure", "wss"],
}
plan = vaso.check(case, **overrides)
print(f"{plan['predicted']['particles']['fluid']} particles, about {plan['predicted']['wall_clock_s']:.0f} s")

# %%
result = vaso.run(case, out=folder / "out", threads=1, force=True, **overrides)
print(result.summary["status"], result.summary["particles"])

# %% [markdown]
# ## The profile
#
# Hagen and Poiseuille: `u(r) = 2 U (1 - r^2 / R^2)`. The blood of the last frame in the middle fifth of the pipe, whose axis is z.

# %%
density, viscosity = 1050.0, 3.6e-3  # [kg/m^3], [Pa s], as in cases/pipe/case.toml
radius, length, mean_velocity = 3.175e-3, 31.75e-3, 53.99325e-3  # [m], [m], [m/s]

blood = result.particles()
position, velocity = blood.position, blood["Velocity"]
middle = np.abs(position[:, 2] - length / 2) < length / 10
r = np.hypot(position[middle, 0], position[middle, 1])
u = velocity[middle, 2]
formula = 2 * mean_velocity * (1 - (r / radius) ** 2)
velocity_error = np.sqrt(np.mean((u - formula) ** 2)) / (2 * mean_velocity)
print(f"velocity: rms {100 * velocity_error:.2f} % of the peak, over {len(u)} particles")

# %% [markdown]
# ## Flow, pressure and the stress on the wall
#
# What goes in comes out. Over a flow that is steady the pressure falls by `8 mu U / R^2`, and the wall is sheared by `4 mu U / R`.

# %%
openings = result.openings
late = openings["time_s"] > 0.75
flow_in, flow_out = (openings[f"{name}.flow_m3_s"][late].mean() for name in ["inlet", "outlet"])
mass_error = (flow_in + flow_out) / flow_out
print(f"flow: {1e6 * flow_out:.4f} ml/s out, {100 * mass_error:+.2f} % more than in")

# `inlet.pressure_pa` is a mean over four spacings behind the buffer of four, so about six spacings from the cap; the outlet's is
# imposed, and zero.
drop = openings["inlet.pressure_pa"][openings["time_s"] > 0.5].mean()
gradient = drop / (length - 6 * result.spacing)
gradient_error = gradient / (8 * viscosity * mean_velocity / radius**2) - 1
print(f"pressure falls by {gradient:.0f} Pa/m, {100 * gradient_error:+.1f} % off")

wall = result.wall[-1]
stress = np.linalg.norm(wall["WSS"], axis=1)
counted = np.abs(wall.position[:, 2] - length / 2) < length / 10
shear = np.nanmean(stress[counted])
shear_error = shear / (4 * viscosity * mean_velocity / radius) - 1
print(f"wall shear stress {shear:.4f} Pa, {100 * shear_error:+.1f} % off ({result.wall.fields['WSS'].definition})")

# %% [markdown]
# ## Pictures

# %%
import matplotlib

matplotlib.use("agg")  # without a screen; leave it out in a notebook
import matplotlib.pyplot as plt

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
along = np.linspace(0, radius, 100)
left.plot(1e3 * r, u, ".", label="particles")
left.plot(1e3 * along, 2 * mean_velocity * (1 - (along / radius) ** 2), label="Poiseuille")
left.set_xlabel("distance from the axis [mm]")
left.set_ylabel("velocity [m/s]")
left.legend()
cut = result.slice("Velocity", origin=[0, 0, length / 2], normal=[0, 0, 1])
vaso.plot_slice(cut, right, label="speed [m/s]")
figure.savefig(folder / "profile.png", dpi=120)

vaso.plot_openings(result).savefig(folder / "openings.png", dpi=120)
