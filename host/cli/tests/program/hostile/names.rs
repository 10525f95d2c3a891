//! Names in a garment become neither paths nor formulas.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use zip::ZipArchive;

fn file(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile-names");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

fn taxel(args: &[&str]) {
    let done = Command::new(env!("CARGO_BIN_EXE_taxel")).args(args).output().unwrap();
    assert!(done.status.success(), "{args:?}: {}", String::from_utf8_lossy(&done.stderr));
}

/// A text in TOML's quotes.
fn quoted(text: &str) -> String {
    let sign = |sign: char| match sign {
        '"' | '\\' => format!("\\{sign}"),
        _ if sign.is_control() => format!("\\u{:04x}", u32::from(sign)),
        _ => sign.into(),
    };
    format!("\"{}\"", text.chars().map(sign).collect::<String>())
}

/// A pat on a garment with one panel and link of these names, recorded and exported.
fn exported(number: usize, panel: &str, link: &str, form: &str, more: &[&str]) -> PathBuf {
    let [garment, recording, output] =
        ["toml", "mcap", form].map(|end| file(&format!("{number}-{}.{end}", more.len())));
    let shipped = include_str!("../../../../taxel/garments/block-4x16.toml");
    let mut text = String::new();
    for line in shipped.lines() {
        let (panel, link) = (format!("name = {}", quoted(panel)), format!("link = {}", quoted(link)));
        let is_panel = text.contains("[[panels]]") && !text.contains("[[blocks]]");
        text += match line.split(' ').next() {
            Some("name") if is_panel => &panel,
            Some("link") if is_panel => &link,
            _ => line,
        };
        text += "\n";
    }
    fs::write(&garment, text).unwrap();
    let names = [&garment, &recording, &output].map(|path| path.to_str().unwrap());
    let record = ["record", "--source", "sim:pat", "--garment", names[0], "--for", "1s"];
    taxel(&[&record[..], &["--force", "-o", names[1]]].concat());
    let export = ["export", names[1], "--to", form, "--force", "-o", names[2]];
    taxel(&[&export[..], more].concat());
    output
}

#[test]
fn an_array_is_never_a_path_nor_another_array() {
    let names = ["../../up", "/etc/cron", "c:\\windows", "..", "frame", "contact_id", "a\u{1b}[2Jb"];
    for (number, name) in names.into_iter().enumerate() {
        let path = exported(number, name, "torso", "npz", &[]);
        let archive = ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
        let entries: Vec<String> = archive.file_names().map(|name| name.unwrap().to_string()).collect();
        assert_eq!(entries.len(), 16, "{name}: {entries:?}");
        for entry in &entries {
            let stem = entry.strip_suffix(".npy").unwrap();
            let plain = |sign: char| sign.is_alphanumeric() || "_- .".contains(sign);
            assert!(stem.chars().all(plain) && !stem.starts_with('.') && !stem.is_empty(), "{entry}");
        }
        assert_eq!(entries.iter().filter(|entry| entry.as_str() == "frame.npy").count(), 1, "{name}");
    }
}

#[test]
fn a_cell_is_never_a_formula() {
    let names = ["=1+1", "+1", "-1", "@sum", "\t=1", "\r=1", "a\rb", "a,b", "a\"b", "=a,\"b"];
    for (number, name) in names.into_iter().enumerate() {
        for more in [&["--touched"][..], &["--contacts", "--every", "2"]] {
            let path = exported(number, name, name, "csv", more);
            let text = fs::read_to_string(path).unwrap();
            let mut lines = text.lines();
            let columns = lines.next().unwrap().split(',').count();
            let mut rows = 0;
            for line in lines {
                let cells = cells(line);
                assert_eq!(cells.len(), columns, "{name:?}: {line:?}");
                let named: Vec<&String> = cells.iter().filter(|cell| cell.parse::<f64>().is_err()).collect();
                assert!(
                    !named.iter().any(|cell| cell.starts_with(['=', '+', '-', '@', '\t', '\r'])),
                    "{line:?}"
                );
                rows += 1;
            }
            assert!(rows > 10, "{name:?}: {rows}");
            assert!(!text.contains('\r'), "{name:?}");
        }
    }
}

/// Cells of a line, without quotes.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for sign in line.chars() {
        match sign {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells.last_mut().unwrap().push(sign),
        }
    }
    cells
}
