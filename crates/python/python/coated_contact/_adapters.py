"""A likelihood as a function of JAX, PyTorch and PyTensor, imported where they are used."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._likelihood import LogLikelihood


def jax(likelihood: LogLikelihood) -> Callable[..., Any]:
    """Return a function of JAX with the derivative of the likelihood."""
    import jax as package
    from jax import numpy as jnp

    def called(values: Any, function: Callable[..., Any], *shapes: tuple[int, ...]) -> Any:
        # An array of the shape of `values` for each block of values that vmap makes.
        results = tuple(package.ShapeDtypeStruct(shape, jnp.float64) for shape in shapes)
        return package.pure_callback(function, results, values, vmap_method="broadcast_all")

    def value(values: Any) -> tuple[Any]:
        return (np.asarray(likelihood(np.asarray(values))),)

    def value_and_gradient(values: Any) -> tuple[Any, Any]:
        found, gradient = likelihood.value_and_gradient(np.asarray(values))
        return np.asarray(found), gradient

    @package.custom_jvp  # type: ignore[untyped-decorator, unused-ignore]
    def function(values: Any) -> Any:
        return called(values, value, values.shape[:-1])[0]

    @function.defjvp  # type: ignore[untyped-decorator, unused-ignore]
    def derivative(primals: Any, tangents: Any) -> Any:
        (values,), (tangent,) = primals, tangents
        found, gradient = called(values, value_and_gradient, values.shape[:-1], values.shape)
        return found, (gradient * tangent).sum(-1)

    def checked(values: Any) -> Any:
        values = jnp.asarray(values)
        if values.dtype != jnp.float64:
            raise TypeError(
                f"values must be of float64, not of {values.dtype}: call "
                'jax.config.update("jax_enable_x64", True) first'
            )
        return function(values)

    return checked


def torch(likelihood: LogLikelihood) -> Callable[..., Any]:
    """Return a function of PyTorch with the derivative of the likelihood."""
    import torch as package

    class Function(package.autograd.Function):  # type: ignore[misc]
        @staticmethod
        def forward(context: Any, values: Any) -> Any:
            given = values.detach().cpu().numpy()
            found, gradient = likelihood.value_and_gradient(given)
            context.save_for_backward(values, values.new_tensor(gradient))
            return values.new_tensor(np.asarray(found))

        @staticmethod
        def backward(context: Any, *outer: Any) -> Any:
            return outer[0].unsqueeze(-1) * Gradient.apply(*context.saved_tensors)

    class Gradient(package.autograd.Function):  # type: ignore[misc]
        """The gradient, so that its derivatives are an error: else they would be 0."""

        @staticmethod
        def forward(context: Any, values: Any, gradient: Any) -> Any:
            return gradient.clone()

        @staticmethod
        def backward(context: Any, *outer: Any) -> Any:
            raise NotImplementedError(
                "the likelihood has first derivatives only: take second ones by differences of them"
            )

    def checked(values: Any) -> Any:
        if values.dtype != package.float64:
            raise TypeError(f"values must be of float64, not of {values.dtype}: values.double()")
        return Function.apply(values)

    return checked


def pytensor(likelihood: LogLikelihood) -> Any:
    """Return an ``Op`` of PyTensor with the derivative of the likelihood."""
    from pytensor import tensor
    from pytensor.graph.op import Op

    class Gradient(Op):  # type: ignore[misc]
        """The gradient of the likelihood."""

        itypes = (tensor.dvector,)
        otypes = (tensor.dvector,)

        def perform(self, node: Any, inputs: Any, outputs: Any) -> None:
            outputs[0][0] = likelihood.gradient(inputs[0])

    class Value(Op):  # type: ignore[misc]
        """The logarithm of the likelihood."""

        itypes = (tensor.dvector,)
        otypes = (tensor.dscalar,)

        def perform(self, node: Any, inputs: Any, outputs: Any) -> None:
            outputs[0][0] = np.asarray(likelihood(inputs[0]))

        def grad(self, inputs: Any, outer: Any) -> list[Any]:
            return [outer[0] * gradient(inputs[0])]

    gradient = Gradient()
    return Value()
