//! Images as Foxglove's [RawImage](https://docs.foxglove.dev/docs/sdk/schemas/raw-image), which Foxglove and
//! Rerun show: the garment's panels side by side, in the order of their taxels, each from the top.

use super::protobuf::{begin, bytes, fixed, message, whole};
use crate::client::{Client, Stamp};
use taxel_core::garment::Area;

/// Name of the schema.
pub const RAW_IMAGE: &str = "foxglove.RawImage";
/// Encoding of messages and schema.
pub const PROTOBUF: &str = "protobuf";

/// Another message as the type of a field, in Protocol Buffers' own numbers.
const MESSAGE: u64 = 11;

/// Appends the client's image; nothing without one. A position beside a lower panel is 0, as one without a taxel.
pub fn append(client: &Client, stamp: Stamp, out: &mut Vec<u8>) {
    let (Some(description), Some((_, image))) = (client.description(), client.image()) else { return };
    let areas = description.layout.areas();
    let width: u32 = areas.iter().map(|area| u32::from(area.columns)).sum();
    let height = areas.iter().map(|area| area.rows).max().unwrap_or(0);
    let step = 2 * width;
    let time = message(|out| {
        whole(out, 1, stamp.host_us / 1_000_000);
        whole(out, 2, stamp.host_us % 1_000_000 * 1000);
    });
    bytes(out, 1, &time);
    fixed(out, 2, width);
    fixed(out, 3, height.into());
    bytes(out, 4, b"mono16");
    fixed(out, 5, step);
    begin(out, 6, step as usize * usize::from(height));
    for row in 0..height {
        areas.iter().for_each(|area| append_row(out, area, row, image));
    }
    bytes(out, 7, description.garment.name.as_bytes());
}

fn append_row(out: &mut Vec<u8>, area: &Area, row: u16, image: &[u16]) {
    let columns = usize::from(area.columns);
    let start = usize::from(area.base) + usize::from(row) * columns;
    let values = image.get(start..start + columns).filter(|_| row < area.rows);
    match values {
        Some(values) => out.extend(values.iter().flat_map(|value| value.to_le_bytes())),
        None => out.resize(out.len() + 2 * columns, 0),
    }
}

/// The schema: a `FileDescriptorSet` with the message and that of its time.
pub fn schema() -> Vec<u8> {
    let time = file(
        "google/protobuf/timestamp.proto",
        "google.protobuf",
        None,
        "Timestamp",
        &[("seconds", 1, 3), ("nanos", 2, 5)],
    );
    let image = file(
        "foxglove/RawImage.proto",
        "foxglove",
        Some("google/protobuf/timestamp.proto"),
        "RawImage",
        &[
            ("timestamp", 1, MESSAGE),
            ("frame_id", 7, 9),
            ("width", 2, 7),
            ("height", 3, 7),
            ("encoding", 4, 9),
            ("step", 5, 7),
            ("data", 6, 12),
        ],
    );
    message(|out| {
        bytes(out, 1, &time);
        bytes(out, 1, &image);
    })
}

/// A `FileDescriptorProto` of one message, whose fields have a name, a number and a type.
fn file(name: &str, package: &str, needs: Option<&str>, of: &str, fields: &[(&str, u64, u64)]) -> Vec<u8> {
    let field = |(name, number, kind): &(&str, u64, u64)| {
        message(|out| {
            bytes(out, 1, name.as_bytes());
            whole(out, 3, *number);
            // Optional.
            whole(out, 4, 1);
            whole(out, 5, *kind);
            if *kind == MESSAGE {
                bytes(out, 6, b".google.protobuf.Timestamp");
            }
        })
    };
    let described = message(|out| {
        bytes(out, 1, of.as_bytes());
        fields.iter().for_each(|it| bytes(out, 2, &field(it)));
    });
    message(|out| {
        bytes(out, 1, name.as_bytes());
        bytes(out, 2, package.as_bytes());
        needs.into_iter().for_each(|file| bytes(out, 3, file.as_bytes()));
        bytes(out, 4, &described);
        bytes(out, 12, b"proto3");
    })
}
