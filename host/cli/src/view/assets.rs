//! Files of the page, embedded in the program.

/// An embedded file.
pub struct Asset {
    /// Media type.
    pub kind: &'static str,
    /// Contents.
    pub bytes: &'static [u8],
}

const HTML: &str = "text/html; charset=utf-8";
const CSS: &str = "text/css; charset=utf-8";
const SCRIPT: &str = "text/javascript; charset=utf-8";

macro_rules! files {
    ($($kind:ident $name:literal),* $(,)?) => {
        &[$((concat!("/", $name), Asset { kind: $kind, bytes: include_bytes!(concat!("page/", $name)) })),*]
    };
}

const FILES: &[(&str, Asset)] = files![
    HTML "index.html",
    CSS "style.css",
    CSS "layout.css",
    CSS "relief.css",
    CSS "hand.css",
    CSS "setup.css",
    SCRIPT "main.js",
    SCRIPT "channel.js",
    SCRIPT "socket.js",
    SCRIPT "speaker.js",
    SCRIPT "store.js",
    SCRIPT "garment.js",
    SCRIPT "units.js",
    SCRIPT "colours.js",
    SCRIPT "panels.js",
    SCRIPT "raster.js",
    SCRIPT "contours.js",
    SCRIPT "marks.js",
    SCRIPT "peaks.js",
    SCRIPT "surface.js",
    SCRIPT "relief.js",
    SCRIPT "relief-gl.js",
    SCRIPT "relief-flat.js",
    SCRIPT "camera.js",
    SCRIPT "mesh.js",
    SCRIPT "axes.js",
    SCRIPT "ranges.js",
    SCRIPT "scale.js",
    SCRIPT "strips.js",
    SCRIPT "strip.js",
    SCRIPT "events.js",
    SCRIPT "timeline.js",
    SCRIPT "timeline-view.js",
    SCRIPT "recorder.js",
    SCRIPT "afterglow.js",
    SCRIPT "follow.js",
    SCRIPT "folds.js",
    SCRIPT "presence.js",
    SCRIPT "body.js",
    SCRIPT "on-robot.js",
    SCRIPT "robot-marks.js",
    SCRIPT "cloth.js",
    SCRIPT "figure.js",
    SCRIPT "regions.js",
    SCRIPT "others.js",
    SCRIPT "whole.js",
    SCRIPT "robot.js",
    SCRIPT "mind.js",
    SCRIPT "orbit.js",
    SCRIPT "drawing.js",
    SCRIPT "fcm.js",
    SCRIPT "layers.js",
    SCRIPT "health.js",
    SCRIPT "contacts.js",
    SCRIPT "bars.js",
    SCRIPT "concepts.js",
    SCRIPT "felt.js",
    SCRIPT "log.js",
    SCRIPT "sentence.js",
    SCRIPT "why.js",
    SCRIPT "link.js",
    SCRIPT "hover.js",
    SCRIPT "hand.js",
    SCRIPT "finger.js",
    SCRIPT "force-law.js",
    SCRIPT "aim.js",
    SCRIPT "tools.js",
    SCRIPT "tool-marks.js",
    SCRIPT "outline.js",
    SCRIPT "limits.js",
    SCRIPT "setup.js",
    SCRIPT "player.js",
    SCRIPT "save.js",
    SCRIPT "controls.js",
    SCRIPT "dom.js",
];

/// Returns the file at a path.
pub fn find(path: &str) -> Option<Asset> {
    let path = if path == "/" { "/index.html" } else { path };
    let found = FILES.iter().find(|(name, _)| *name == path);
    found.map(|(_, asset)| Asset { kind: asset.kind, bytes: asset.bytes })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_folder_is_served_and_every_import_is_there() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/view/page");
        let mut names: Vec<_> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| format!("/{}", entry.unwrap().file_name().to_str().unwrap()))
            // Types are for the check alone.
            .filter(|name| !name.ends_with(".d.ts"))
            .collect();
        names.sort();
        let mut served: Vec<_> = FILES.iter().map(|(name, _)| name.to_string()).collect();
        served.sort();
        assert_eq!(served, names);
        for (name, asset) in FILES {
            let text = std::str::from_utf8(asset.bytes).unwrap();
            for import in text.split("from \"./").skip(1) {
                let import = import.split('"').next().unwrap();
                assert!(find(&format!("/{import}")).is_some(), "{name} imports {import}");
            }
            // Nothing is fetched from elsewhere. The namespace of SVG is a name, not an address.
            let foreign = text.replace("http://www.w3.org/2000/svg", "");
            assert!(!foreign.contains("http://") && !foreign.contains("https://"), "{name}");
        }
        assert!(find("/").is_some() && find("/../mod.rs").is_none() && find("").is_none());
    }
}
