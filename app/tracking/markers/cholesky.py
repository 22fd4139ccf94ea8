"""Solution of a small positive definite system, inside a kernel (compiled)."""

from typing import Any

import numpy as np

from app.core.compiled import REORDERED, njit


@njit(fastmath=REORDERED)
def factorise(matrix: Any) -> bool:
    """Replace the lower triangle by Cholesky's factor; False if it is not positive definite."""
    size = matrix.shape[0]
    column = np.empty(size)
    for j in range(size):
        if not matrix[j, j] > 0.0:
            return False
        matrix[j, j] = np.sqrt(matrix[j, j])
        for i in range(j + 1, size):
            x = matrix[i, j] / matrix[j, j]
            matrix[i, j] = column[i] = x
            if x != 0.0:
                for k in range(j + 1, i + 1):
                    matrix[i, k] -= x * column[k]
    return True


@njit(fastmath=REORDERED)
def halve(factor: Any, right: Any) -> None:
    """Replace B, (size, n), by L⁻¹ B: products of two such are those with the inverse between."""
    size, count = right.shape
    for i in range(size):
        for k in range(i):
            x = factor[i, k]
            if x != 0.0:
                for c in range(count):
                    right[i, c] -= x * right[k, c]
        for c in range(count):
            right[i, c] /= factor[i, i]


@njit(fastmath=REORDERED)
def finish(factor: Any, right: Any) -> None:
    """Replace L⁻¹ B by (L Lᵀ)⁻¹ B."""
    size, count = right.shape
    for i in range(size - 1, -1, -1):
        for k in range(i + 1, size):
            x = factor[k, i]
            if x != 0.0:
                for c in range(count):
                    right[i, c] -= x * right[k, c]
        for c in range(count):
            right[i, c] /= factor[i, i]
