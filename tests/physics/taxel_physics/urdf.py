"""Other robots: a URDF and its meshes as MuJoCo takes them.

MuJoCo knows no ``package://``, names a mesh by the stem of its file, of which there may be two, and leaves
out links on fixed joints. Here each mesh gets a name of its own, and each link stays.
"""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import mujoco


def load(urdf: Path, packages: Path) -> mujoco.MjModel:
    """Model of a URDF with the collision geoms of its links; ``packages`` is the folder of ``package://``.

    Meshes of kinds that MuJoCo cannot read are left out. Raises ``ValueError`` for a mesh that is not there.
    """
    tree = ElementTree.fromstring(urdf.read_text(encoding="utf-8"))
    assets: dict[str, bytes] = {}
    for link in tree.iter("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
        for collision in link.findall("collision"):
            mesh = collision.find("geometry/mesh")
            if mesh is None:
                continue
            file = _file(mesh.attrib["filename"], urdf, packages)
            if file.suffix.lower() not in (".stl", ".obj"):
                link.remove(collision)
                continue
            name = re.sub(r"\W+", "_", str(file.with_suffix(""))) + file.suffix.lower()
            assets[name] = file.read_bytes()
            mesh.attrib["filename"] = name
    own = ElementTree.SubElement(tree, "mujoco")
    ElementTree.SubElement(own, "compiler", fusestatic="false", discardvisual="false", balanceinertia="true")
    return mujoco.MjModel.from_xml_string(ElementTree.tostring(tree, encoding="unicode"), assets)


def _file(name: str, urdf: Path, packages: Path) -> Path:
    """The file of a mesh."""
    inside = name.removeprefix("package://")
    file = packages / inside if inside != name else urdf.parent / name
    if not file.is_file():
        raise ValueError(f"{urdf.name} names {name}, which is not there")
    return file
