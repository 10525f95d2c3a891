"""Packs what is given away. What it writes follows from the content and SOURCE_DATE_EPOCH alone."""

import base64
import gzip
import hashlib
import io
import json
import os
import subprocess
import sys
import tarfile
import time
import zipfile
from collections import defaultdict
from pathlib import Path
from typing import Any

TIME = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
# Names of the files in which a crate's licences and notices stand.
NOTICES = ("LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE", "UNLICENSE")
HEAD = """What taxel's program, Python package and firmware are made of, and the licences of it.

taxel itself is MIT or Apache-2.0, as you like (LICENSE-MIT, LICENSE-APACHE). The source of each crate is on
crates.io under its name and version: also that of `serialport`, which is under MPL-2.0 and used unchanged.
The Rust standard library is MIT or Apache-2.0 (https://github.com/rust-lang/rust).
"""


def files(path: Path) -> list[tuple[str, Path]]:
    """A file, or the files of a folder, with their names in an archive."""
    if path.is_file():
        return [(path.name, path)]
    inside = sorted(file for file in path.rglob("*") if file.is_file() and "__pycache__" not in file.parts)
    return [(file.relative_to(path.parent).as_posix(), file) for file in inside]


def mode(content: bytes) -> int:
    """Programs may be run; the modes of a checkout depend on the machine."""
    return 0o755 if content[:4] == b"\x7fELF" else 0o644


def archive(out: Path, paths: list[Path]) -> None:
    """Packs files and folders into a folder that is named like the archive."""
    is_zip = out.suffix == ".zip"
    top = out.name.removesuffix(".zip").removesuffix(".tar.gz")
    content = sorted((f"{top}/{name}", file.read_bytes()) for path in paths for name, file in files(path))
    if is_zip:
        write_zip(out, content)
        return
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as tar:
        for name, bytes_ in content:
            entry = tarfile.TarInfo(name)
            entry.size, entry.mtime, entry.mode = len(bytes_), TIME, mode(bytes_)
            tar.addfile(entry, io.BytesIO(bytes_))
    with out.open("wb") as file, gzip.GzipFile("", "wb", 9, file, TIME) as compressed:
        compressed.write(packed.getvalue())


def write_zip(out: Path, content: list[tuple[str, bytes]]) -> None:
    # The format begins in 1980.
    when = time.gmtime(max(TIME, 315_532_800))[:6]
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for name, bytes_ in content:
            entry = zipfile.ZipInfo(name, when)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, (0o100000 | mode(bytes_)) << 16
            entry.create_system = 3
            packed.writestr(entry, bytes_)


def wheel(built: Path, licences: Path, out: Path) -> None:
    """Packs a wheel anew, with the licences of what is linked."""
    with zipfile.ZipFile(built) as packed:
        content = {name: packed.read(name) for name in packed.namelist()}
    record = next(name for name in content if name.endswith(".dist-info/RECORD"))
    del content[record]
    info = record.removesuffix("RECORD")
    content[f"{info}licenses/{licences.name}"] = licences.read_bytes()
    # A list with a time and a random number, which the one beside the wheel replaces.
    content = {name: bytes_ for name, bytes_ in content.items() if not name.startswith(f"{info}sboms/")}
    lines = []
    for name, bytes_ in sorted(content.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(bytes_).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(bytes_)}\n")
    content[record] = "".join([*lines, f"{record},,\n"]).encode()
    write_zip(out / built.name, sorted(content.items()))


class Linked:
    """The crates that a package links, by cargo's own resolution. Without those of build scripts and tests."""

    def __init__(self, manifest: Path, package: str, features: str) -> None:
        command = ["cargo", "metadata", "--locked", "--format-version", "1", "--manifest-path", str(manifest)]
        command += ["--features", features] if features else []
        known = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
        packages = {found["id"]: found for found in known["packages"]}
        nodes = {node["id"]: node["deps"] for node in known["resolve"]["nodes"]}
        self.root: dict[str, Any] = next(found for found in packages.values() if found["name"] == package)
        self.crates = [self.root]
        # For each crate, those that it links.
        self.needs: list[list[dict[str, Any]]] = []
        for crate in self.crates:
            kinds = ((packages[needed["pkg"]], needed["dep_kinds"]) for needed in nodes[crate["id"]])
            needs = [needed for needed, of in kinds if any(kind["kind"] is None for kind in of)]
            self.needs.append(needs)
            self.crates += [needed for needed in needs if needed not in self.crates]


def purl(crate: dict[str, Any]) -> str:
    return f"pkg:cargo/{crate['name']}@{crate['version']}"


def component(crate: dict[str, Any], kind: str) -> dict[str, Any]:
    """A crate, as CycloneDX has it. Older crates have a list of licences in place of an expression."""
    licence = (crate["license"] or "").replace("/", " OR ")
    described = {"type": kind, "name": crate["name"], "version": crate["version"], "purl": purl(crate)}
    return {**described, "bom-ref": purl(crate), "licenses": [{"expression": licence}]}


def sbom(manifest: Path, package: Path, features: Path, out: Path) -> None:
    """Lists what a package links, in CycloneDX format."""
    linked = Linked(manifest, str(package), str(features))
    edges = sorted((purl(crate), sorted(map(purl, needs))) for crate, needs in zip(linked.crates, linked.needs))
    listed = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {
            "timestamp": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(TIME)),
            "component": component(linked.root, "application"),
        },
        "components": [component(crate, "library") for crate in sorted(linked.crates[1:], key=purl)],
        "dependencies": [{"ref": crate, "dependsOn": needs} for crate, needs in edges],
    }
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps(listed, indent=1) + "\n")


def licences(out: Path, *lists: Path) -> None:
    """Names each crate of the registry that is linked, and each text of its licences once. `lists` are a manifest, a
    package and its features, and so on."""
    found = [Linked(lists[at], str(lists[at + 1]), str(lists[at + 2])) for at in range(0, len(lists), 3)]
    crates = {purl(crate): crate for linked in found for crate in linked.crates if crate["source"]}
    texts: dict[str, list[str]] = defaultdict(list)
    lines = [HEAD]
    for _, crate in sorted(crates.items()):
        name = f"{crate['name']} {crate['version']}"
        lines.append(f"{name}: {crate['license']}, {crate['repository'] or 'crates.io'}")
        for notice in sorted(Path(crate["manifest_path"]).parent.iterdir()):
            if notice.is_file() and notice.name.upper().startswith(NOTICES):
                texts[notice.read_text(errors="replace").replace("\r\n", "\n").strip()].append(name)
    for text, names in sorted(texts.items(), key=lambda entry: entry[1]):
        lines.append(f"\n{'-' * 100}\n{', '.join(names)}:\n\n{text}")
    out.write_text("\n".join(lines) + "\n")


def digests(folder: Path) -> dict[str, str]:
    """SHA-256 of each file of a folder."""
    names = sorted(file for file in folder.iterdir() if file.is_file() and file.name != "SHA256SUMS")
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in names}


def sums(folder: Path) -> None:
    """Writes the checksums, as `sha256sum --check` reads them, and prints them with sizes."""
    known = digests(folder)
    (folder / "SHA256SUMS").write_text("".join(f"{digest}  {name}\n" for name, digest in known.items()))
    for name, digest in known.items():
        print(f"{digest}  {(folder / name).stat().st_size:>10}  {name}")


def compare(one: Path, other: Path) -> None:
    """Compares two folders; the error names what differs, in an archive each file."""
    a, b = digests(one), digests(other)
    differ = [name for name in sorted(a.keys() | b.keys()) if a.get(name) != b.get(name)]
    for name in sorted(a.keys() | b.keys()):
        missing = [folder for folder, known in ((one, a), (other, b)) if name not in known]
        print(f"{name}: {f'NOT IN {missing[0]}' if missing else 'DIFFERS' if name in differ else 'equal'}")
        if name in differ and name in a and name in b:
            inside, outside = members(one / name), members(other / name)
            unequal = sorted(m for m in inside.keys() | outside.keys() if inside.get(m) != outside.get(m))
            print("".join(f"  {member}\n" for member in unequal), end="")
    if differ:
        sys.exit(f"{len(differ)} of {len(a.keys() | b.keys())} files differ")


def notes(changelog: Path, version: Path, out: Path) -> None:
    """Writes what the changelog says of a version."""
    sections = changelog.read_text().split("\n## ")
    found = [text for text in sections if text.split("\n", 1)[0].strip() == str(version)]
    if len(found) != 1:
        sys.exit(f"{changelog} has {len(found)} sections of {version}")
    out.write_text(found[0].split("\n", 1)[1].strip() + "\n")


def members(path: Path) -> dict[str, bytes]:
    """The files of an archive; none of another file."""
    if path.suffix in (".zip", ".whl"):
        with zipfile.ZipFile(path) as packed:
            return {name: packed.read(name) for name in packed.namelist()}
    if path.name.endswith(".tar.gz"):
        with tarfile.open(path) as tar:
            kept = ((entry.name, tar.extractfile(entry)) for entry in tar if entry.isfile())
            return {name: file.read() for name, file in kept if file}
    return {}


def main(what: str, *given: str) -> None:
    paths = [Path(word) for word in given]
    match what:
        case "archive":
            archive(paths[0], paths[1:])
        case "wheel":
            wheel(*paths)
        case "sbom":
            sbom(*paths)
        case "licences":
            licences(*paths)
        case "sums":
            sums(*paths)
        case "compare":
            compare(*paths)
        case "notes":
            notes(*paths)
        case _:
            sys.exit(f"{what}: no such task")


if __name__ == "__main__":
    main(*sys.argv[1:])
