//! Definitions of messages (`.msg`), and messages read by them: fields in their order, each with its type.

use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A field: type and name.
type Field = (String, String);

/// Definitions by name, with and without their package.
#[derive(Debug, Default)]
pub struct Definitions(BTreeMap<String, Vec<Field>>);

/// Folder of our package.
pub fn package() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../ros2/taxel_msgs")
}

impl Definitions {
    /// The files of our package, and what they use of others.
    pub fn of_package() -> Definitions {
        let mut all = Definitions::default();
        for entry in std::fs::read_dir(package().join("msg")).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap().to_string();
            all.add(&name, &std::fs::read_to_string(&path).unwrap());
        }
        all.add("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id");
        all.add("builtin_interfaces/Time", "int32 sec\nuint32 nanosec");
        for name in ["geometry_msgs/Point", "geometry_msgs/Vector3"] {
            all.add(name, "float64 x\nfloat64 y\nfloat64 z");
        }
        all
    }

    /// A text as recordings have it: a definition named `name`, then those that it uses.
    pub fn of_text(name: &str, text: &str) -> Definitions {
        let mut all = Definitions::default();
        let mut parts = text.split("====\n");
        all.add(name, parts.next().unwrap());
        for part in parts {
            let (head, rest) = part.split_once('\n').unwrap();
            all.add(head.strip_prefix("MSG: ").unwrap(), rest);
        }
        all
    }

    /// Names of our messages.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str).filter(|name| !name.contains('/'))
    }

    fn add(&mut self, name: &str, text: &str) {
        let field = |line: &str| {
            let line = line.split('#').next()?.trim();
            let (kind, name) = line.split_once(' ')?;
            // A constant is no field.
            (!name.contains('=')).then(|| (kind.to_string(), name.to_string()))
        };
        self.0.insert(name.into(), text.lines().filter_map(field).collect());
    }

    /// Reads a whole message of a type, with its header of four bytes.
    pub fn read(&self, kind: &str, message: &[u8]) -> Value {
        assert_eq!(message[..4], [0, 1, 0, 0], "{kind}");
        let mut reader = CdrReader { bytes: &message[4..], at: 0 };
        let value = self.value(kind, &mut reader);
        assert_eq!(reader.at, reader.bytes.len(), "{kind}: bytes are left over");
        value
    }

    fn value(&self, kind: &str, reader: &mut CdrReader<'_>) -> Value {
        if let Some(element) = kind.strip_suffix("[]") {
            let length = u32::from_le_bytes(reader.number());
            return (0..length).map(|_| self.value(element, reader)).collect();
        }
        match kind {
            "bool" => json!(reader.number::<1>()[0] == 1),
            "uint8" | "byte" => json!(reader.number::<1>()[0]),
            "uint16" => json!(u16::from_le_bytes(reader.number())),
            "uint32" => json!(u32::from_le_bytes(reader.number())),
            "uint64" => json!(u64::from_le_bytes(reader.number())),
            "int32" => json!(i32::from_le_bytes(reader.number())),
            // NaN is null.
            "float64" => json!(f64::from_le_bytes(reader.number())),
            "string" => json!(reader.text()),
            _ => {
                let short = kind.split('/').next_back().unwrap();
                let fields = self.0.get(kind).or_else(|| self.0.get(short));
                let fields = fields.unwrap_or_else(|| panic!("there is no definition of {kind}"));
                let each = fields.iter().map(|(kind, name)| (name.clone(), self.value(kind, reader)));
                Value::Object(each.collect::<Map<_, _>>())
            }
        }
    }
}

/// The rest of a message.
struct CdrReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl CdrReader<'_> {
    /// A number, aligned to its size.
    fn number<const N: usize>(&mut self) -> [u8; N] {
        self.at = self.at.next_multiple_of(N);
        let number = self.bytes[self.at..self.at + N].try_into().unwrap();
        self.at += N;
        number
    }

    fn text(&mut self) -> String {
        let length = u32::from_le_bytes(self.number()) as usize;
        let text = &self.bytes[self.at..self.at + length];
        self.at += length;
        assert_eq!(text.last(), Some(&0));
        String::from_utf8(text[..length - 1].to_vec()).unwrap()
    }
}
