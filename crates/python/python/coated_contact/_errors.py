"""The errors. Each message names the value, the values allowed and the next step.

A file that cannot be read is an ``OSError`` (such as ``FileNotFoundError``) with its name.
"""

from __future__ import annotations


class ContactError(ValueError):
    """A value or a table that cannot be used.

    Attributes
    ----------
    axis : str or None
        The name of the parameter that is refused, where there is one.
    value : float or None
        Its value.
    range : tuple of float or None
        The smallest and the largest value allowed, where they are two numbers.
    allowed : str or None
        The values allowed in words, where they are no range.
    index : tuple of int or None
        The position of the first point with an error, where arrays were given.
    """

    def __init__(
        self,
        message: str,
        *,
        axis: str | None = None,
        value: float | None = None,
        range: tuple[float, float] | None = None,  # noqa: A002
        allowed: str | None = None,
        index: tuple[int, ...] | None = None,
    ) -> None:
        super().__init__(message)
        self.axis = axis
        self.value = value
        self.range = range
        self.allowed = allowed
        self.index = index


class UnphysicalError(ContactError):
    """A value that no physical system has, or a result that overflows a float."""


class InvalidArgumentError(ContactError):
    """An argument whose value the computation does not accept."""


class BeyondSphereError(ContactError):
    """A contact radius that is not below the radius of the sphere."""


class BeyondProbeError(ContactError):
    """A contact radius that the shape of the probe does not have."""


class OtherProbeError(ContactError):
    """A question that makes no sense for the shape of the probe, or is not answered for it."""


class FrictionError(ContactError):
    """A contact with full friction that is not solved, or a question that it does not answer."""


class ProfileError(ContactError):
    """Points of a measured probe that are no convex shape; ``value`` is the row, from 1."""


class OutsideTableError(ContactError):
    """A material outside the box of the table, or an a/t outside the curve."""


class ExtrapolationError(OutsideTableError):
    """An a/t beyond the nodes, where the expansion about the limit is not accurate enough."""


class OutsideRadiiError(ContactError):
    """A state whose contact radius is outside the range of the search."""


class NoContactError(ContactError):
    """A load, penetration or position of the spring at which there is no contact."""


class EquivalentError(ContactError):
    """A material without an equivalent in a table made for another substrate's Poisson ratio."""


class NormalisationError(ContactError):
    """A rigid sphere in a table for compliant spheres, or the other way round."""


class MissingQuantityError(ContactError):
    """A quantity that the table does not hold."""


class FixedParameterError(ContactError):
    """A derivative that is not known."""


class OtherTableError(ContactError):
    """A table of other bodies: of a stack for one film, of films for a stack, of another stack."""


class TableError(ContactError):
    """A file that is no table, a damaged one, or one of another version."""


class DomainError(ContactError):
    """A parameter or a tolerance outside the domain of the solver."""


class NotConvergedError(ContactError):
    """A tolerance that double precision does not allow; ``range`` begins at the error reached."""


class StackError(ContactError):
    """A layer that a stack cannot have; ``value`` is its number, from 1 at the base."""


class LongZoneError(ContactError):
    """A zone of attraction that is not short beside the contact radius or the film."""


class NotAContactError(ContactError):
    """An attraction of finite range that has no solution at a contact radius."""


class FitError(ContactError):
    """A fit that cannot be made: points, parameters or options that cannot be used."""


class GenerationError(ContactError):
    """A scene that cannot be used, or a table that cannot be made."""
