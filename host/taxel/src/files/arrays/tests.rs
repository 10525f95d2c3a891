use super::*;
use npyz::WriterBuilder;
use std::io::{Cursor, Write as _};
use std::path::PathBuf;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// A file with this name in a folder of this test run.
fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("taxel-arrays-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

fn npy<T: npyz::AutoSerialize + Copy>(shape: &[u64], order: npyz::Order, values: &[T]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let options = npyz::WriteOptions::new().default_dtype().shape(shape).order(order);
    let mut writer = options.writer(&mut bytes).begin_nd().unwrap();
    writer.extend(values.iter().copied()).unwrap();
    writer.finish().unwrap();
    bytes
}

/// An archive of the arrays `name: shape`, filled with 0, 1, 2, ...
fn npz(arrays: &[(&str, &[u64])]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, shape) in arrays {
        let values: Vec<u16> = (0..shape.iter().product::<u64>() as u16).collect();
        writer.start_file(format!("{name}.npy"), SimpleFileOptions::default()).unwrap();
        writer.write_all(&npy(shape, npyz::Order::C, &values)).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

fn numbers() -> Vec<u16> {
    (0..24).collect()
}

/// The error of reading a file, without the folder.
fn error(name: &str, bytes: &[u8], array: Option<&str>) -> String {
    let path = file(name, bytes);
    let text = format!("{:#}", read(&path, array).unwrap_err());
    text.replace(&format!("{}/", path.parent().unwrap().display()), "")
}

#[test]
fn a_type_that_is_no_number_is_named_before_its_size() {
    for (name, width) in
        [("<M8[ns]", 8), ("|O", 8), ("<c16", 16), ("<f2", 2), ("|b1", 1), ("<U3", 12), ("|V5", 5)]
    {
        let text = format!("{{'descr': '{name}', 'fortran_order': False, 'shape': (2, 3), }}\n");
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((text.len() as u16).to_le_bytes());
        bytes.extend(text.bytes());
        bytes.resize(bytes.len() + 6 * width, 0);
        let want = format!("typed.npy: holds values of type {name}, expected integers, f32 or f64");
        assert_eq!(error("typed.npy", &bytes, None), want);
    }
}

#[test]
fn every_number_type_and_order_is_read() {
    let want = Frames { rows: 3, columns: 4, count: 2, values: numbers() };
    let shape = [2, 3, 4];
    macro_rules! check {
        ($($kind:ty)*) => { $(
            let values: Vec<_> = numbers().into_iter().map(|v| v as $kind).collect();
            let path = file(concat!(stringify!($kind), ".npy"), &npy(&shape, npyz::Order::C, &values));
            assert_eq!(read(&path, None).unwrap(), want);
        )* };
    }
    check!(u8 u16 u32 u64 i8 i16 i32 i64 f32 f64);
    // In Fortran order the first index runs fastest.
    let turned: Vec<u16> = (0..24).map(|i| (i % 2) * 12 + (i / 2 % 3) * 4 + i / 6).collect();
    let path = file("fortran.npy", &npy(&shape, npyz::Order::Fortran, &turned));
    assert_eq!(read(&path, None).unwrap(), want);
    let turned: Vec<u16> = (0..12).map(|i| (i % 3) * 4 + i / 3).collect();
    let one = read(&file("image.npy", &npy(&[3, 4], npyz::Order::Fortran, &turned)), None).unwrap();
    assert_eq!((one.count, one.frame(0), one.frame(1)), (1, want.frame(0), None));
}

#[test]
fn a_value_that_is_no_count_is_named() {
    let with = |bad: f64| {
        let mut values = vec![7.0; 24];
        values[17] = bad;
        npy(&[2, 3, 4], npyz::Order::C, &values)
    };
    for (bad, text) in [(f64::NAN, "NaN"), (0.5, "0.5"), (-1.0, "-1"), (65536.0, "65536"), (1.0 / 0.0, "inf")]
    {
        let want = format!("bad.npy: frame 1, row 1, column 1: {text} is not an integer in 0 ..= 65535");
        assert_eq!(error("bad.npy", &with(bad), None), want);
    }
    let mut cells = vec![0i32; 24];
    cells[3] = -5;
    let bytes = npy(&[2, 3, 4], npyz::Order::Fortran, &cells);
    assert!(error("turned.npy", &bytes, None).contains("frame 1, row 1, column 0: -5 is not"));
}

#[test]
fn a_wrong_shape_is_named() {
    for shape in [&[24][..], &[1, 1, 2, 3, 4], &[2, 0, 4]] {
        let count = shape.iter().product::<u64>() as usize;
        let text = error("shape.npy", &npy(shape, npyz::Order::C, &numbers()[..count]), None);
        assert!(text.starts_with(&format!("shape.npy: shape {shape:?}: ")), "{text}");
    }
    let wide = npy(&[1, 65536], npyz::Order::C, &[0u8; 65536]);
    let want = "wide.npy: shape [1, 65536]: a frame has at most 65535 rows and columns";
    assert_eq!(error("wide.npy", &wide, None), want);
    let mut long = npy(&[4, 6], npyz::Order::C, &numbers());
    long.push(0);
    assert_eq!(error("long.npy", &long, None), "long.npy: shape [4, 6] takes 48 bytes, there are more");
}

#[test]
fn a_file_cut_anywhere_is_an_error() {
    let whole = npy(&[2, 3, 4], npyz::Order::C, &numbers());
    for end in 0..whole.len() {
        let text = error("cut.npy", &whole[..end], None);
        assert!(text.starts_with("cut.npy: ") && !text.contains('\n'), "{end} {text}");
    }
    let want = "cut.npy: truncated: shape [2, 3, 4] takes 48 bytes, there are 47";
    assert_eq!(error("cut.npy", &whole[..whole.len() - 1], None), want);
    let archive = npz(&[("a", &[2, 3, 4])]);
    for end in 0..archive.len() {
        assert!(error("cut.npz", &archive[..end], None).starts_with("cut.npz: "));
    }
}

/// Nothing panics, and no false size makes much memory be allocated, whatever byte is changed.
#[test]
fn every_wrong_byte_is_survived() {
    for (name, whole) in [
        ("byte.npy", npy(&[2, 3, 4], npyz::Order::C, &numbers())),
        ("byte.npz", npz(&[("a", &[2, 3, 4]), ("b", &[3])])),
    ] {
        for at in 0..whole.len() {
            for flip in [1, 0x10, 0x80, 0xff] {
                let mut bytes = whole.clone();
                bytes[at] ^= flip;
                let _ = read(&file(name, &bytes), None);
            }
        }
    }
}

#[test]
fn claims_of_a_header_are_checked() {
    let header = |text: &str| {
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((text.len() as u16).to_le_bytes());
        bytes.extend(text.as_bytes());
        error("claim.npy", &bytes, None)
    };
    let shape = |shape: &str| header(&format!("{{'descr':'<u2','fortran_order':False,'shape':{shape},}}\n"));
    let want =
        "claim.npy: truncated: shape [1000000000000, 64, 32] takes 4096000000000000 bytes, there are 0";
    assert_eq!(shape("(1000000000000, 64, 32)"), want);
    let want = "claim.npy: shape [18446744073709551615, 2]: a frame has at most 65535 rows and columns";
    assert_eq!(shape("(18446744073709551615, 2)"), want);
    for wild in ["(0xffffffffffffffff, 2)", "(18446744073709551616, 2)", "(-1, 2)", "(1e3, 2)", "5", "'x'"] {
        let want = "claim.npy: has a header that is not one of a NumPy array";
        assert!(shape(wild).starts_with(want), "{wild}");
    }
    assert!(header(&"(".repeat(60_000)).contains("header"));
    let nested = format!("{{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), {}", "{".repeat(40));
    assert!(header(&nested).contains("header"));
    assert!(header("{'descr': '|O', 'fortran_order': False, 'shape': (2, 2), }").contains("type |O"));
    let records = "{'descr': [('a', '<u2')], 'fortran_order': False, 'shape': (2, 2), }";
    assert_eq!(header(records), "claim.npy: holds records, expected numbers");
}

#[test]
fn an_array_of_an_archive_is_chosen() {
    let one = file("one.npz", &npz(&[("labels", &[5]), ("frames", &[2, 3, 4])]));
    assert_eq!(read(&one, None).unwrap().values, numbers());
    assert_eq!(read(&one, Some("frames")).unwrap().count, 2);
    let two = npz(&[("b", &[2, 3, 4]), ("a", &[3, 4]), ("c", &[7])]);
    assert_eq!(error("two.npz", &two, None), "two.npz: holds several arrays, choose one with --array: a, b");
    assert_eq!(error("two.npz", &two, Some("x")), "two.npz: there is no array x; known are a, b, c");
    let want = "two.npz: array c: shape [7]: expected [frames, rows, columns] or [rows, columns]";
    assert_eq!(error("two.npz", &two, Some("c")), want);
    let all = read_all(&file("two.npz", &two)).unwrap();
    let all: Vec<_> = all.iter().map(|(name, frames)| (name.as_str(), frames.count)).collect();
    assert_eq!(all, [("a", 1), ("b", 2)]);
    assert!(
        error("none.npz", &npz(&[("c", &[7]), ("d", &[2])]), None).starts_with("none.npz: holds no array")
    );
    let image = npy(&[4, 6], npyz::Order::C, &numbers());
    let want = "image.npy: holds one array without a name, so array a cannot be chosen";
    assert_eq!(error("image.npy", &image, Some("a")), want);
    assert_eq!(read_all(&file("image.npy", &image)).unwrap()[0].0, "image");
}

#[test]
fn text_is_read_frame_by_frame() {
    let text = "# two frames\n0, 1, 2\r\n3,4,5.0\n\n\n6,7,8\n9,1e1,11\n";
    let have = read(&file("two.csv", text.as_bytes()), None).unwrap();
    assert_eq!(have, Frames { rows: 2, columns: 3, count: 2, values: (0..12).collect() });
    for (text, want) in [
        ("1,2\n3\n", "line 2: 1 columns, and the first row has 2"),
        ("1,2\n3,4\n\n5,6\n\n7,8\n", "line 5: frame 1 has 1 rows, and the first 2"),
        ("1\n2\n\n3\n", "at its end: frame 1 has 1 rows, and the first 2"),
        ("x,y\n1,2\n", "line 1: column 0: \"x\" is not a number"),
        ("1,2\n\n3,nan\n", "line 3: frame 1, row 0, column 1: NaN is not an integer in 0 ..= 65535"),
        ("1,,2\n", "line 1: column 1: \"\" is not a number"),
        ("\n# nothing\n", "there are no values"),
    ] {
        assert_eq!(error("bad.csv", text.as_bytes(), None), format!("bad.csv: {want}"));
    }
    assert!(error("bad.csv", b"\xff\xfe1,2", None).starts_with("bad.csv: not a text"));
}

#[test]
fn what_is_no_array_file_is_said() {
    assert_eq!(error("image.png", b"...", None), "image.png: not an array file: expected .npy, .npz or .csv");
    assert_eq!(error("image.npy", b"...", None), "image.npy: not a NumPy array");
    assert_eq!(error("image.npz", b"", None), "image.npz: not a NumPy archive");
    let missing = format!("{:#}", read(Path::new("/no/such.npy"), None).unwrap_err());
    assert!(missing.starts_with("/no/such.npy: cannot be read: "), "{missing}");
    assert!(read(&std::env::temp_dir(), None).is_err());
}
