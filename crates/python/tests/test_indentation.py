"""Contact stiffness: the two slopes of a contact, and fits of what nanoindenters measure."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import coated_contact as cc
from conftest import refuses

DIAMOND = 1.1466e12
OXIDE = cc.Elastic(young_modulus=7.2e10, poisson_ratio=0.17)
SILICON = cc.Elastic(young_modulus=1.7e11, poisson_ratio=0.28)


def system(thickness: float = 5e-7) -> cc.System:
    return cc.System(
        sphere_radius=1e-5,
        sphere_modulus=DIAMOND,
        film=OXIDE,
        film_thickness=thickness,
        substrate=SILICON,
    )


def test_a_flat_punch_has_no_moving_stiffness() -> None:
    punch = cc.HalfSpace(probe=cc.FlatPunch(radius=1e-6), sphere_modulus=DIAMOND, solid=SILICON)
    contact = cc.Contact.half_space(punch)
    with pytest.raises(cc.InputError):
        contact.moving_stiffness(1e-6, 0.1)
    assert np.isnan(contact.moving_stiffness(1e-6, 0.1, errors="nan"))


def test_a_reference_sample_tells_tip_and_frame() -> None:
    berkovich = cc.Indentation(beta=1.034, hardness=1e10, tip_rounding=6e-9, frame_compliance=2e-7)
    depths = np.linspace(4e-8, 2.2e-7, 40)
    silicon = cc.HalfSpace(sphere_radius=1e-5, sphere_modulus=DIAMOND, solid=SILICON)
    film = cc.Experiment(
        kind="stiffness-depth", abscissa=depths, system=system(), indentation=berkovich
    )
    bare = replace(film, system=silicon, indentation=replace(berkovich, reference=True))
    made = [cc.simulate(one, noise=0.003, seed=i) for i, one in enumerate([film, bare])]
    assert made[0].indentation.loads is not None
    found = cc.fit(made, ["film_modulus", "tip_rounding", "frame_compliance"])
    for name, truth in [
        ("film_modulus", 7.2e10),
        ("tip_rounding", 6e-9),
        ("frame_compliance", 2e-7),
    ]:
        assert abs(found.params[name] - truth) < 3.5 * found.stderr[name], name
    with pytest.raises(cc.FitError, match="reference"):
        cc.fit(replace(made[0], indentation=made[1].indentation), ["film_modulus"])


def test_predictions_are_beta_times_the_stiffness() -> None:
    radii = [2e-7, 8e-7]
    beta = cc.Indentation(beta=1.034)
    plan = cc.Experiment(kind="stiffness-radius", abscissa=radii, system=system(), indentation=beta)
    expected = 1.034 * cc.Table.embedded().contact(system()).stiffness(radii)
    assert np.allclose(cc.predict(plan).ordinate, expected, rtol=1e-9)


def test_phases_tell_the_loss_tangent() -> None:
    # Under a rigid sphere and on a rigid base the loss tangent is that of the stiffness.
    gel = cc.Elastic(young_modulus=1e6, poisson_ratio=0.45)
    rigid = cc.Elastic(young_modulus=np.inf, poisson_ratio=0.3)
    bodies = cc.System(
        sphere_radius=1e-4,
        sphere_modulus=np.inf,
        film=gel,
        film_thickness=1e-6,
        substrate=rigid,
    )
    radii = np.linspace(3e-7, 3e-6, 10)
    stiffness = cc.Table.embedded().contact(bodies).stiffness(radii)
    measured = cc.Experiment(
        kind="stiffness-radius",
        abscissa=radii,
        ordinate=stiffness * np.cos(0.3),
        system=bodies,
        indentation=cc.Indentation(phases=np.full(10, 0.3)),
        noise=1e-3,
    )
    found = cc.fit(measured, ["film_modulus"])
    assert found.params["film_modulus"] == pytest.approx(1e6, rel=1e-4)
    loss = found.experiments[0].loss
    assert loss is not None
    assert loss["tangent"] == pytest.approx(np.tan(0.3), rel=1e-4)
    too_viscous = replace(measured, indentation=cc.Indentation(phases=np.full(10, 0.9)))
    refuses(cc.FitError, "loss tangent", lambda: cc.fit(too_viscous, ["film_modulus"]))


def test_files_of_nanoindenters_are_read(tmp_path: Path) -> None:
    rows = "\n".join(f"{50 + 10 * i},{0.3 + 0.1 * i},{2e4 + 3e3 * i}" for i in range(12))
    file = tmp_path / "csm.csv"
    file.write_text(
        "Displacement Into Surface (nm),Load On Sample (mN),Harmonic Contact Stiffness (N/m)\n"
        f"-1,0.001,1.797e308\n{rows}\n"
    )
    read = cc.read_experiment(
        file,
        "stiffness-depth",
        system=system(),
        between=(6e-8, 1.5e-7),
        indentation=cc.Indentation(beta=1.034),
    )
    assert len(read.abscissa) == 10
    assert read.indentation.beta == 1.034
    assert np.allclose(read.indentation.loads, 1e-3 * (0.4 + 0.1 * np.arange(10)))
    assert "outside the range" in read.reading


@pytest.mark.parametrize(
    ("known", "words"),
    [
        ({"epsilon": -1}, "epsilon"),
        ({"area": [0.0]}, "area function"),
        ({"frame_compliance": -1.0}, "frame.compliance"),
        ({"thinning": 0.3}, "thinning"),
    ],
)
def test_wrong_indenters_are_refused(known: dict[str, object], words: str) -> None:
    measured = cc.Experiment(
        kind="stiffness-radius",
        abscissa=[1e-7, 2e-7, 3e-7],
        ordinate=[4e4, 8e4, 1.2e5],
        system=system(),
        indentation=cc.Indentation(**known),  # type: ignore[arg-type]
    )
    refuses(cc.FitError, words, lambda: cc.fit(measured, [cc.Free(parameter="film_modulus")]))


def test_words_of_another_kind_are_refused() -> None:
    refuses(cc.FitError, "oliver-pharr", lambda: cc.Indentation(contact_depth="hertz"))
    with pytest.raises(TypeError, match="Indentation"):
        cc.Experiment(
            kind="stiffness-radius",
            abscissa=[1e-7],
            system=system(),
            indentation={"beta": 1.0},  # type: ignore[arg-type]
        )
