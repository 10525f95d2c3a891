//! The kinds of errors that a program can distinguish: each is really returned.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use taxel::error::{
    ArrayError, Error, ErrorKind, FileError, LearnError, MapFileError, RecordingError, SettingError,
    SourceError, UsageError,
};
use taxel::files::bases::Base;
use taxel::files::calibrate::Calibration;
use taxel::files::output::{Force, Output};
use taxel::files::{arrays, garments, scripts};
use taxel::recording::{Clips, Format, Messages, Overview, Writer};
use taxel::session::setting;
use taxel::source::SceneFile;
use taxel::{client::Client, fcm};

/// A test's folder, deleted at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("taxel-errors-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, content).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        _ = fs::remove_dir_all(&self.0);
    }
}

/// The error of a result, whose value may not be printable.
fn failed<T>(result: Result<T, Error>) -> Error {
    match result {
        Ok(_) => panic!("it is an error"),
        Err(error) => error,
    }
}

/// A recording of one chunk with the topic `/a`.
fn recording(folder: &Folder) -> PathBuf {
    let path = folder.0.join("whole.mcap");
    let mut writer = Writer::create(File::create_new(&path).unwrap(), "").unwrap();
    let format = Format { encoding: "json", schema: "a", schema_encoding: "jsonschema", text: b"{}" };
    let channel = writer.channel("/a", &format).unwrap();
    (0..4).for_each(|time| writer.message(channel, time, time, &[b'x'; 50]).unwrap());
    writer.finish().unwrap();
    path
}

#[test]
fn a_file_that_is_missing_is_named_by_each_reader() {
    let missing = Path::new("/no/such/file.toml");
    let text = missing.to_str().unwrap();
    let errors = [
        failed(arrays::read(missing, None)),
        failed(garments::read(text)),
        failed(scripts::load(text)),
        failed(SceneFile::read(missing)),
        failed(fcm::load::map(text)),
        failed(Calibration::read(missing)),
        failed(Base::open(missing)),
        failed(Overview::of(missing)),
        failed(Messages::open(missing)),
        failed(taxel::open("replay:/no/such/file.toml")),
    ];
    for error in errors {
        match error.kind() {
            ErrorKind::File(FileError::Missing { path, .. }) => assert_eq!(path, missing, "{error:#}"),
            other => panic!("{error:#}: {other:?}"),
        }
        assert_eq!(error.io().map(std::io::Error::kind), Some(std::io::ErrorKind::NotFound));
    }
}

#[test]
fn an_output_that_exists_is_distinguished_from_one_that_cannot_be() {
    let folder = Folder::new("outputs");
    let there = folder.file("there.csv", "old");
    let none: [&Path; 0] = [];
    let error = failed(Output::file(&there, Force { force: false }, none));
    assert!(
        matches!(error.kind(), ErrorKind::File(FileError::Exists { path }) if *path == there),
        "{error:?}"
    );
    let error = failed(Output::file(&folder.0, Force { force: false }, none));
    assert!(matches!(error.kind(), ErrorKind::File(FileError::Output(_))), "{error:?}");
    let error = failed(Output::file(&there, Force { force: true }, [&there]));
    assert!(matches!(error.kind(), ErrorKind::Usage(UsageError::Argument(_))), "{error:?}");
}

#[test]
fn garbage_a_foreign_recording_and_a_damaged_one_are_distinguished() {
    let folder = Folder::new("recordings");
    let garbage = folder.file("garbage.mcap", [0xA5; 4096]);
    for error in [failed(Overview::of(&garbage)), failed(Messages::open(&garbage))] {
        match error.kind() {
            ErrorKind::Recording(RecordingError::NotMcap { path }) => assert_eq!(*path, garbage),
            other => panic!("{other:?}"),
        }
    }
    let error = failed(Overview::of(&folder.0));
    assert!(matches!(error.kind(), ErrorKind::File(FileError::NoFile { .. })), "{error:?}");
    let whole = recording(&folder);
    let error = failed(taxel::open(&format!("replay:{}", whole.display())));
    assert!(matches!(error.kind(), ErrorKind::Recording(RecordingError::NotTaxel { .. })), "{error:?}");
    let mut clips = Clips::open(&whole.as_path().into(), "/a").unwrap();
    assert_eq!(clips.clip(0).unwrap().len(), 4);
    let mut bytes = fs::read(&whole).unwrap();
    // In the first block of its LZ4 frame.
    let frame = bytes.windows(4).position(|four| four == [0x04, 0x22, 0x4D, 0x18]).unwrap();
    bytes[frame + 12] ^= 0x5A;
    let damaged = folder.file("damaged.mcap", bytes);
    let error = failed(Clips::open(&damaged.as_path().into(), "/a").and_then(|mut clips| clips.clip(0)));
    match error.kind() {
        ErrorKind::Recording(RecordingError::Damaged { path, .. }) => assert_eq!(*path, damaged),
        other => panic!("{other:?}"),
    }
}

#[test]
fn arrays_that_are_none_damaged_or_unfit_are_distinguished() {
    let folder = Folder::new("arrays");
    let of = |name: &str, bytes: &[u8]| failed(arrays::read(&folder.file(name, bytes), None)).into_kind();
    assert!(matches!(of("a.npy", b"no array"), ErrorKind::Array(ArrayError::NotAnArray(_))));
    assert!(matches!(of("a.npz", b"PK no archive"), ErrorKind::Array(ArrayError::NotAnArray(_))));
    let text = "{'descr': '<u2', 'fortran_order': False, 'shape': (9, 4, 4), }\n";
    let head = [b"\x93NUMPY\x01\0", &(text.len() as u16).to_le_bytes()[..], text.as_bytes()].concat();
    assert!(matches!(of("b.npy", &head), ErrorKind::Array(ArrayError::Damaged(_))));
    let flat = String::from_utf8_lossy(&head[10..]).replace("(9, 4, 4)", "(9, 4, 0)");
    let head = [&head[..10], flat.as_bytes()].concat();
    assert!(matches!(of("c.npy", &head), ErrorKind::Array(ArrayError::Unfit(_))));
}

#[test]
fn a_source_that_is_not_there_and_one_that_does_not_exist_are_distinguished() {
    for source in ["serial:/dev/no-such-port", "tcp:127.0.0.1:1"] {
        let error = failed(taxel::open(source));
        match error.kind() {
            ErrorKind::Source(error @ SourceError::NoBoard(_)) => assert!(error.blames_board()),
            other => panic!("{other:?}"),
        }
    }
    for source in ["usb3", "sim:pit", "tcp:nowhere"] {
        let error = failed(taxel::open(source));
        assert!(matches!(error.kind(), ErrorKind::Usage(UsageError::Unknown(_))), "{error:?}");
    }
}

#[test]
fn an_invalid_map_names_its_version_its_key_or_its_concept() {
    let text = "name = \"m\"\nversion = 9\n[[concept]]\nname = \"a\"\n";
    let error = failed(fcm::load::parse(text, "m.toml"));
    assert!(matches!(error.kind(), ErrorKind::Map(MapFileError::Version { found: 9, .. })), "{error:?}");
    let text = "name = \"m\"\n[[concept]]\nname = \"a\"\n[[concept]]\nname = \"a\"\n";
    let error = failed(fcm::load::parse(text, "m.toml"));
    assert_eq!(error.kind().parameter().as_deref(), Some("concept[1].name"), "{error:?}");
    assert!(error.to_string().starts_with("m.toml, line 5, `name`: "), "{error}");
    let error = failed(fcm::load::parse("name = 3", "m.toml"));
    assert!(matches!(error.kind(), ErrorKind::Map(MapFileError::Malformed(_))), "{error:?}");
    let map = fcm::load::map("tactile").unwrap();
    match failed(map.index("joy", "--of")).into_kind() {
        ErrorKind::Map(MapFileError::NoConcept { concept, .. }) => assert_eq!(concept, "joy"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_invalid_setting_names_its_parameter() {
    let of = |result: Result<(), Error>| failed(result).kind().parameter().unwrap_or_default();
    let mut client = Client::new();
    assert_eq!(
        of(setting::gestures(taxel_core::gesture::ShippedModel::Intent, None, Some(2.0)).map(drop)),
        "gestures.certainty"
    );
    let scene = SceneFile::named("contact = { low = 0 }").unwrap();
    assert_eq!(of(setting::set_scene(&mut client, &scene)), "contact.low");
    assert_eq!(of(SceneFile::named("contact = { lo = 3 }").map(drop)), "contact.lo");
    assert_eq!(of(scripts::parse("duration_s = -1", "a.toml").map(drop)), "duration_s");
    let folder = Folder::new("settings");
    let text = garments::read("block-4x16").unwrap().text.replacen("name = \"", "name = 3 # \"", 1);
    let garment = folder.file("garment.toml", text);
    let error = failed(garments::read(garment.to_str().unwrap()));
    assert!(matches!(error.kind(), ErrorKind::Setting(SettingError::Malformed(_))), "{error:?}");
}

#[test]
fn a_base_of_another_version_is_distinguished_from_one_that_is_none() {
    let error = failed(Base::parse("{ \"kind\": \"taxel shapes 9\" }"));
    assert!(matches!(error.kind(), ErrorKind::Learn(LearnError::Version(_))), "{error:?}");
    let error = failed(Base::parse("{}"));
    assert!(matches!(error.kind(), ErrorKind::Learn(LearnError::Base(_))), "{error:?}");
}

#[test]
fn contexts_keep_the_kind_and_errors_of_the_caller_pass_through() {
    let script = scripts::parse("duration_s = 1\ngarment = \"shirt\"", "a.toml").unwrap();
    let error = failed(scripts::garment(&script));
    assert!(matches!(error.kind(), ErrorKind::Usage(UsageError::Unknown(_))), "{error:?}");
    assert_eq!(error.to_string(), "in script a: `garment`");
    assert!(
        format!("{error:#}").starts_with("in script a: `garment`: there is no garment \"shirt\"; known are ")
    );
    let error = Error::other("my own").context("while doing mine");
    assert!(matches!(error.kind(), ErrorKind::Other(own) if own.to_string() == "my own"));
}
