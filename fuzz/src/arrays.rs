//! Array files of any bytes: an array, an archive, a table, and an archive whose entries are such bytes behind
//! valid checksums.

use crate::bytes::Bytes;
use crate::scratch::Scratch;
use std::io::{Cursor, Write};
use taxel::files::arrays;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Names of arrays that readers ask for.
const NAMES: [&str; 3] = ["frames", "labels", "classes"];

/// Reads the bytes as the kind of file that the first of them chooses.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let file = match bytes.byte() % 4 {
        0 => Scratch::new(bytes.rest(), "npy"),
        1 => Scratch::new(bytes.rest(), "npz"),
        2 => Scratch::new(bytes.rest(), "csv"),
        _ => Scratch::new(&archive(&mut bytes), "npz"),
    };
    let path = file.path();
    for (name, frames) in arrays::read_all(path).unwrap_or_default() {
        let area = usize::from(frames.rows) * usize::from(frames.columns);
        assert_eq!(frames.values.len(), frames.count * area, "{name}");
        assert!(frames.count > 0 && area > 0, "{name}: there are frames");
        assert_eq!(frames.iter().count(), frames.count, "{name}");
    }
    for name in arrays::names(path).unwrap_or_default() {
        let _ = (arrays::read(path, Some(&name)), arrays::list(path, &name), arrays::texts(path, &name));
    }
    let _ = arrays::read(path, None);
}

/// An archive of arrays, one for each piece.
fn archive(bytes: &mut Bytes<'_>) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for name in NAMES {
        if bytes.is_empty() {
            break;
        }
        writer.start_file(format!("{name}.npy"), SimpleFileOptions::default()).expect("a name that is new");
        writer.write_all(bytes.piece()).expect("there is memory");
    }
    writer.finish().expect("there is memory").into_inner()
}
