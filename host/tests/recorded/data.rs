//! Where recordings lie: in one of the folders that TAXEL_DATA lists, as PATH lists folders.

use std::path::PathBuf;

/// The file or folder of this name in the first of the folders that holds it.
pub fn find(name: &str) -> PathBuf {
    let listed = std::env::var_os("TAXEL_DATA").expect("TAXEL_DATA lists no folders of recordings");
    let mut places = std::env::split_paths(&listed).map(|folder| folder.join(name));
    places.find(|path| path.exists()).unwrap_or_else(|| panic!("no folder of TAXEL_DATA holds {name}"))
}
