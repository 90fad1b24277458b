# %% [markdown]
# # What accuracy costs
#
# A direct solve takes the tolerance that is asked for and states its error. The table has one
# accuracy, and costs nanoseconds. Times are those of the machine that runs this notebook.

# %%
from time import perf_counter

import matplotlib.pyplot as plt
import numpy as np

from coated_contact import Elastic, System, Table, solve


def seconds(work, least=0.05):
    """The time of one call, from as many as take a while."""
    calls, start = 0, perf_counter()
    while perf_counter() - start < least:
        work()
        calls += 1
    return (perf_counter() - start) / calls


# %% [markdown]
# ## Direct solves
#
# Thin, medium and thick films of the elastomer of Barthel's paper, incompressible, on silicon.

# %%
tolerances = np.logspace(-2, -11, 10)
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
for x in (0.1, 1.0, 65.0, 1000.0):
    exact = solve(x, 1.75, 0.5, 1e5, tolerance=1e-12)
    times, errors = [], []
    for tolerance in tolerances:
        solution = solve(x, 1.75, 0.5, 1e5, tolerance=tolerance)
        errors.append(max(abs(solution.gamma / exact.gamma - 1), 1e-16))
        batch = np.full(64, x)
        times.append(
            seconds(lambda b=batch, t=tolerance: solve(b, 1.75, 0.5, 1e5, tolerance=t)) / 64
        )
        assert errors[-1] <= solution.error + exact.error
    axes.loglog(1e6 * np.array(times), errors, ".-", label=f"a/t = {x:g}")
axes.set_xlabel("time of a solve on all cores (µs)")
axes.set_ylabel("true error of gamma")
axes.legend()

# %% [markdown]
# ## The table
#
# A new material costs microseconds, a further load nanoseconds.

# %%
film = Elastic(young_modulus=3.5e6, poisson_ratio=0.5)
silicon = Elastic(young_modulus=2e11, poisson_ratio=0.25)
system = System(
    sphere_radius=1e-3, sphere_modulus=2e6, film=film, film_thickness=1e-5, substrate=silicon
)
contact = Table.embedded().contact(system)
a = np.linspace(4e-5, 1e-4, 100_000)
print(f"new contact   {1e6 * seconds(lambda: Table.embedded().contact(system)):8.1f} µs")
print(f"load          {1e9 * seconds(lambda: contact.load(a, 0.04)) / len(a):8.1f} ns a point")
print(f"with gradient {1e9 * seconds(lambda: contact.gradient(a, 0.04)) / len(a):8.1f} ns a point")

# %% [markdown]
# Its error, against direct solves at other points than its nodes:

# %%
x = np.geomspace(1e-2, 1e2, 300)
exact = solve(x, 1.75, 0.5, 1e5, tolerance=1e-11)
stiffness = contact.stiffness(x[x < 99] * 1e-5)
error = stiffness / (2 * x[x < 99] * 1e-5 * 2e6 * exact.eeq[x < 99]) - 1
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
axes.loglog(x[x < 99], np.abs(error))
axes.set_xlabel("a/t")
axes.set_ylabel("relative error of the stiffness")
print(f"largest {np.abs(error).max():.1e}")
