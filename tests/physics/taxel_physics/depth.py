"""How deep points lie inside a geom of MuJoCo."""

from __future__ import annotations

import mujoco
import numpy as np
import numpy.typing as npt

from .robot import World

Array = npt.NDArray[np.float64]


def depth(world: World, geom: int, points: Array) -> Array:
    """(n,) Depth of points (n, 3; world, m) inside a geom, m; negative outside.

    Exact for spheres, capsules, boxes and cylinders. For a convex mesh it is exact inside, and beside a face.
    Raises ``ValueError`` for other geoms.
    """
    model = world.model
    turned = np.array(world.data.geom_xmat[geom]).reshape(3, 3)
    local = (points - world.data.geom_xpos[geom]) @ turned
    size = np.array(model.geom_size[geom])
    match mujoco.mjtGeom(int(model.geom_type[geom])):
        case mujoco.mjtGeom.mjGEOM_SPHERE:
            return float(size[0]) - _length(local)
        case mujoco.mjtGeom.mjGEOM_CAPSULE:
            local[:, 2] -= np.clip(local[:, 2], -size[1], size[1])
            return float(size[0]) - _length(local)
        case mujoco.mjtGeom.mjGEOM_BOX:
            return -_outside(np.abs(local) - size)
        case mujoco.mjtGeom.mjGEOM_CYLINDER:
            radial = np.hypot(local[:, 0], local[:, 1]) - size[0]
            return -_outside(np.column_stack([radial, np.abs(local[:, 2]) - size[1]]))
        case mujoco.mjtGeom.mjGEOM_MESH:
            normals, offsets = _planes(model, int(model.geom_dataid[geom]))
            least: Array = (offsets[:, None] - normals @ local.T).min(axis=0)
            return least
        case other:
            raise ValueError(f"the depth inside a geom of type {other.name} is not known")


def _length(vectors: Array) -> Array:
    lengths: Array = np.linalg.norm(vectors, axis=1)
    return lengths


def _outside(beyond: Array) -> Array:
    """Signed distance from what is ``beyond`` (n, k) each pair of faces."""
    inside: Array = np.minimum(beyond.max(axis=1), 0.0)
    return _length(np.maximum(beyond, 0.0)) + inside


def _planes(model: mujoco.MjModel, mesh: int) -> tuple[Array, Array]:
    """Outward normals (faces, 3) and offsets (faces,) of the faces of a convex mesh."""
    first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
    vertices = np.array(model.mesh_vert[first : first + count], np.float64)
    first, count = model.mesh_faceadr[mesh], model.mesh_facenum[mesh]
    corners = vertices[model.mesh_face[first : first + count]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return normals, np.einsum("ij,ij->i", normals, corners[:, 0])
