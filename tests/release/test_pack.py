"""The packer: the same content gives the same bytes, and what differs is named."""

import io
import os
import tempfile
import unittest
import zipfile
from contextlib import redirect_stdout
from pathlib import Path

import pack


class Pack(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def content(self, name: str, program: bytes, moment: int) -> list[Path]:
        """A program and a folder, as another checkout at another moment has them."""
        made = self.folder / name
        (made / "examples").mkdir(parents=True)
        for path, bytes_ in ((made / "taxel", program), (made / "examples/b.toml", b"b"), (made / "examples/a.toml", b"a")):
            path.write_bytes(bytes_)
            path.chmod(0o600)
            os.utime(path, (moment, moment))
        return [made / "taxel", made / "examples"]

    def test_archives_depend_on_their_content_alone(self) -> None:
        for end in ("tar.gz", "zip"):
            outs = [self.folder / name / f"taxel-1.{end}" for name in ("one", "two")]
            for number, out in enumerate(outs):
                out.parent.mkdir(exist_ok=True)
                pack.archive(out, self.content(f"{end}{number}", b"\x7fELF", 10**9 * number))
            self.assertEqual(outs[0].read_bytes(), outs[1].read_bytes())
            names = ["taxel-1/examples/a.toml", "taxel-1/examples/b.toml", "taxel-1/taxel"]
            self.assertEqual(sorted(pack.members(outs[0])), names)

    def test_what_differs_is_named(self) -> None:
        for name, program in (("one", b"1"), ("two", b"2")):
            (self.folder / name).mkdir()
            pack.archive(self.folder / name / "taxel-1.zip", self.content(f"of {name}", program, 0))
            (self.folder / name / "same.txt").write_text("same")
        (self.folder / "one/only.txt").write_text("only")
        said = io.StringIO()
        with redirect_stdout(said), self.assertRaises(SystemExit) as end:
            pack.compare(self.folder / "one", self.folder / "two")
        lines = [f"only.txt: NOT IN {self.folder / 'two'}", "same.txt: equal", "taxel-1.zip: DIFFERS", "  taxel-1/taxel"]
        self.assertEqual(said.getvalue().splitlines(), lines)
        self.assertEqual(end.exception.code, "2 of 3 files differ")

    def test_a_wheel_gets_the_licences_and_its_record_holds(self) -> None:
        built, licences = self.folder / "taxel-1-py3-none-any.whl", self.folder / "THIRD-PARTY.txt"
        licences.write_text("MIT")
        with zipfile.ZipFile(built, "w") as packed:
            for name in ("taxel/__init__.py", "taxel-1.dist-info/METADATA", "taxel-1.dist-info/RECORD"):
                packed.writestr(name, name)
        out = self.folder / "out"
        out.mkdir()
        pack.wheel(built, licences, out)
        known = pack.members(out / built.name)
        record = known["taxel-1.dist-info/RECORD"].decode().splitlines()
        self.assertEqual(sorted(line.split(",")[0] for line in record), sorted(known))
        # The digest of "MIT", in the alphabet for names and without padding, as the format has it.
        digest = "5dz_6Da27IpY5JJBm1UOZfuMvcMIUDl55drLM6x-o7c"
        self.assertIn(f"taxel-1.dist-info/licenses/THIRD-PARTY.txt,sha256={digest},3", record)

    def test_notes_are_of_one_version(self) -> None:
        log, out = self.folder / "CHANGELOG.md", self.folder / "notes.md"
        log.write_text("# Changelog\n\n## 0.2.0\n\n- New.\n\n## 0.1.0\n\n- Old.\n")
        pack.notes(log, Path("0.2.0"), out)
        self.assertEqual(out.read_text(), "- New.\n")
        with self.assertRaises(SystemExit):
            pack.notes(log, Path("0.3.0"), out)


if __name__ == "__main__":
    unittest.main()
