//! Folders of recordings, as listed by TAXEL_DATA in the format of PATH.

use std::path::PathBuf;

/// Path of the file or folder with this name in the first folder that has it.
pub fn find(name: &str) -> PathBuf {
    let listed = std::env::var_os("TAXEL_DATA").expect("TAXEL_DATA lists no folders of recordings");
    let mut places = std::env::split_paths(&listed).map(|folder| folder.join(name));
    places.find(|path| path.exists()).unwrap_or_else(|| panic!("no folder of TAXEL_DATA holds {name}"))
}
