# SPDX-License-Identifier: MIT OR Apache-2.0
"""The curve skeleton by Laplacian contraction and topological thinning (thesis §4.3.2).

Contraction: the points x of the closed design part are moved to the least-squares solution of

    W_L L x = 0        (contract: L is the cotangent Laplacian of the present shape)
    W_H x   = W_H x₀   (stay)

with W_L growing and W_H raised where triangles have shrunk, until the surface has lost most of its
area.  Thinning: samples by farthest points with a ball of 0.02 of the diagonal are joined where
their points share a triangle, and triangles of samples are collapsed at their shortest side.
"""

from __future__ import annotations

import heapq

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

#: Radius of the sampling ball over the diagonal of the bounding box (thesis §4.3.2).
BALL = 0.02
#: First weight of the contraction and its growth from round to round. Stronger ones contract the
#: struts along their length too, and lose what hangs on them.
FIRST_WEIGHT, GROWTH = 2.0, 1.5
MOST_ROUNDS = 20
#: The contraction ends at this part of the first area: later ends are no better centred.
THIN = 0.3


def laplacian(points: np.ndarray, triangles: np.ndarray) -> sparse.csr_matrix:
    """Cotangent Laplacian; flat corners are bounded, so that thin triangles do not rule."""
    rows, columns, weights = [], [], []
    for k in range(3):
        apex, a, b = triangles[:, k], triangles[:, (k + 1) % 3], triangles[:, (k + 2) % 3]
        u, v = points[a] - points[apex], points[b] - points[apex]
        area = np.linalg.norm(np.cross(u, v), axis=1)
        cotangent = np.einsum("ij,ij->i", u, v) / np.maximum(area, 1e-12 * area.max())
        cotangent = np.clip(cotangent, 1e-3, 1e3)
        rows += [a, b]
        columns += [b, a]
        weights += [cotangent, cotangent]
    n = len(points)
    w = sparse.coo_matrix(
        (np.concatenate(weights), (np.concatenate(rows), np.concatenate(columns))), shape=(n, n)
    ).tocsr()
    degree = np.asarray(w.sum(axis=1)).ravel()
    return sparse.diags(1.0 / degree) @ (w - sparse.diags(degree))


def ring_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Area of the triangles around each point."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    sums = np.zeros(len(points))
    for k in range(3):
        np.add.at(sums, triangles[:, k], areas)
    return sums


def contract(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Moves the points until the surface is thin."""
    first = ring_areas(points, triangles)
    pull = FIRST_WEIGHT
    x = points.copy()
    for _ in range(MOST_ROUNDS):
        shrunk = ring_areas(x, triangles)
        if shrunk.sum() < THIN * first.sum():
            break
        stay = np.sqrt(first / np.maximum(shrunk, 1e-9 * first))
        lap = laplacian(x, triangles) * pull
        normal = (lap.T @ lap + sparse.diags(stay**2)).tocsc()
        x = splu(normal).solve(stay[:, None] ** 2 * x)
        pull *= GROWTH
    return x


def farthest_samples(points: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Samples that cover all points within the radius; the nearest sample of each point."""
    distance = np.full(len(points), np.inf)
    nearest = np.zeros(len(points), dtype=int)
    samples: list[int] = []
    farthest = 0
    while distance[farthest] > radius:
        away = np.linalg.norm(points - points[farthest], axis=1)
        closer = away < distance
        nearest[closer] = len(samples)
        distance = np.minimum(distance, away)
        samples.append(farthest)
        farthest = int(distance.argmax())
    return np.array(samples), nearest


def thin(places: np.ndarray, links: dict[int, set[int]]) -> None:
    """Collapses the sides of triangles, the shortest first, until there is none."""

    def length(a: int, b: int) -> float:
        return float(np.linalg.norm(places[a] - places[b]))

    heap = [(length(a, b), a, b) for a in links for b in links[a] if a < b]
    heapq.heapify(heap)
    while heap:
        known, a, b = heapq.heappop(heap)
        if b not in links.get(a, ()) or known != length(a, b) or not links[a] & links[b]:
            continue
        places[a] = (places[a] + places[b]) / 2
        for c in links.pop(b):
            links[c].discard(b)
            if c != a:
                links[c].add(a)
                links[a].add(c)
        for c in sorted(links[a]):
            heapq.heappush(heap, (length(a, c), min(a, c), max(a, c)))
            for d in sorted(links[c]):
                heapq.heappush(heap, (length(c, d), min(c, d), max(c, d)))


def skeleton(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, list[tuple[int, int]]]:
    """Places and segments of the skeleton of a closed surface."""
    contracted = contract(points, triangles)
    size = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    samples, nearest = farthest_samples(contracted, BALL * size)
    places = contracted[samples].copy()
    links: dict[int, set[int]] = {i: set() for i in range(len(samples))}
    for triangle in nearest[triangles]:
        for k in range(3):
            a, b = int(triangle[k]), int(triangle[(k + 1) % 3])
            if a != b:
                links[a].add(b)
                links[b].add(a)
    thin(places, links)
    kept = {old: new for new, old in enumerate(sorted(links))}
    segments = [(kept[a], kept[b]) for a in links for b in links[a] if a < b]
    return places[sorted(links)], segments
