//! Folders in which the commands run.

use crate::cases::{Case, Output};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};

/// Files by their paths inside a folder.
pub type Files = BTreeMap<String, Vec<u8>>;

/// A file that a link may lead to and that must not change.
pub const PRECIOUS: &str = "nobody may write this";

/// A mesh on which a panel fits.
const BOARD: &str = "v 0 -1 -1\nv 0 1 -1\nv 0 1 1\nv 0 -1 1\nf 1 2 3 4\n";

/// A robot of two boards.
const ROBOT: &str = "name = \"two\"\n\
                     [[boards]]\nname = \"left\"\nsource = \"sim:press\"\n\
                     [[boards]]\nname = \"right\"\nsource = \"sim:press\"\n";

/// Touches of the chest at places of the torso.
const KNOWN: &str = "panel,column,row,link,x,y,z\n\
                     chest,7.5,15.5,torso,0.0611,0,0.2\n\
                     chest,7.5,5.5,torso,0.0611,0,0.3\n\
                     chest,7.5,25.5,torso,0.0611,0,0.1\n";

/// The inputs of all commands, and a folder for each run.
pub struct Stage {
    root: PathBuf,
    inputs: Files,
}

impl Stage {
    /// Creates the inputs.
    pub fn new(name: &str) -> Stage {
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("disk-{name}-{}", std::process::id()));
        let folder = root.join("inputs");
        fs::create_dir_all(&folder).unwrap();
        let root = fs::canonicalize(root).unwrap();
        let run = |args: &[&str]| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_taxel"));
            let done = command.args(args).current_dir(&folder).stderr(Stdio::null()).status().unwrap();
            assert!(done.success(), "{args:?}");
        };
        run(&[
            "record",
            "--source",
            "sim:pat",
            "--garment",
            "block-4x16",
            "--frames",
            "120",
            "-o",
            "in.mcap",
        ]);
        let whole = fs::read(folder.join("in.mcap")).unwrap();
        fs::write(folder.join("cut.mcap"), &whole[..whole.len() - 100]).unwrap();
        fs::write(folder.join("touches.csv"), TOUCHES).unwrap();
        fs::write(folder.join("box.toml"), BOX).unwrap();
        fs::write(folder.join("robot.toml"), ROBOT).unwrap();
        fs::write(folder.join("board.obj"), BOARD).unwrap();
        fs::write(folder.join("known.csv"), KNOWN).unwrap();
        let weights = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/scenes/weights.toml");
        fs::copy(weights, folder.join("weights.toml")).unwrap();
        run(&["shapes", "learn", "box", "--source", "sim:box.toml", "--touches", "2", "-o", "base.json"]);
        let inputs = read(&folder);
        Stage { root, inputs }
    }

    /// Contents of a folder before a run.
    pub fn before(&self, case: &Case, replaces: bool) -> Files {
        let mut files: Files = self.inputs.clone();
        if replaces {
            let old = case.outputs.iter().flat_map(Output::old);
            old.for_each(|name| _ = files.entry(name).or_insert(b"old".into()));
        }
        files
    }

    /// A new folder with these files, and beside it the precious file. Returns its paths.
    pub fn folder(&self, files: &Files) -> Place {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let around = self.root.join(format!("run-{}", COUNT.fetch_add(1, Ordering::Relaxed)));
        let place = Place { folder: around.join("disk"), around };
        fs::create_dir_all(place.around.join("precious-folder")).unwrap();
        fs::create_dir_all(place.held()).unwrap();
        fs::write(place.around.join("precious"), PRECIOUS).unwrap();
        fs::write(place.around.join("precious-folder/file.png"), PRECIOUS).unwrap();
        for (name, bytes) in files {
            let path = place.folder.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
        place
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        _ = fs::remove_dir_all(&self.root);
    }
}

/// Folder of a run; deleted when dropped.
pub struct Place {
    pub around: PathBuf,
    pub folder: PathBuf,
}

impl Place {
    /// Folder with copies of the contents at the time of the fault.
    pub fn held(&self) -> PathBuf {
        self.around.join("held")
    }

    /// True if the precious file is unchanged.
    pub fn is_precious_safe(&self) -> bool {
        let safe =
            |name: &str| fs::read(self.around.join(name)).is_ok_and(|text| text == PRECIOUS.as_bytes());
        let alone = fs::read_dir(self.around.join("precious-folder")).unwrap().count() == 1;
        safe("precious") && safe("precious-folder/file.png") && alone
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        _ = fs::remove_dir_all(&self.around);
    }
}

/// All files below a folder; links and empty folders are represented by files that describe them.
pub fn read(folder: &Path) -> Files {
    fn add(folder: &Path, inside: &str, files: &mut Files) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = format!("{inside}{}", path.file_name().unwrap().to_string_lossy());
            let kind = fs::symlink_metadata(&path).unwrap().file_type();
            if kind.is_dir() {
                add(&path, &format!("{name}/"), files);
            } else if kind.is_symlink() {
                files.insert(name, b"a link".into());
            } else {
                files.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    let mut files = Files::new();
    add(folder, "", &mut files);
    files
}

const TOUCHES: &str = "time,location,label\n-0.9,0.1,attack\n-0.01,0.9,none\n-0.8,0,attack\n0,0,none\n";
const BOX: &str = "duration_s = 2\ngarment = \"block-4x16\"\n[[touch]]\npanel = \"mat\"\nshape = \"box\"\n\
    force_n = 8\nat = [7, 1.5]\nsize_mm = [20, 20]\nstart_s = 0.2\nrise_s = 0.1\nhold_s = 0.55\nfall_s = 0.05\n\
    repeat = 2\nperiod_s = 0.9\n";
