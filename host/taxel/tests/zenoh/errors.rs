//! Files and networks that cannot be used.

use crate::stage::{Network, folder};
use taxel::error::{ErrorKind, FileError, SourceError, UsageError};
use taxel::network::{self, NetworkEnd};

fn error(name: &str, text: &str) -> taxel::Error {
    let path = folder().join(name);
    std::fs::write(&path, text).unwrap();
    match network::open(NetworkEnd::Viewer, Some(&path)) {
        Ok(_) => panic!("{text}: it is taken"),
        Err(error) => error,
    }
}

#[test]
fn a_wrong_file_is_named_with_its_key() {
    for (text, ends) in [
        ("{ mode: ", "wrong.json5: it is not JSON5"),
        ("[]", "wrong.json5: it holds no settings in braces"),
        ("{ mode: \"boss\" }", "wrong.json5: mode: "),
        ("{ lissten: {} }", "wrong.json5: lissten: "),
        ("{ transport: { link: { tls: 3 } } }", "wrong.json5: transport: "),
    ] {
        let error = error("wrong.json5", text);
        assert!(matches!(error.kind(), ErrorKind::Usage(UsageError::Argument(_))), "{error}");
        assert!(error.to_string().contains(ends) && !error.to_string().contains(".rs"), "{error}");
    }
    let Err(missing) = network::open(NetworkEnd::Viewer, Some(&folder().join("no-such.json5"))) else {
        panic!("it does not exist")
    };
    assert!(matches!(missing.kind(), ErrorKind::File(FileError::Missing { .. })), "{missing}");
}

#[test]
fn nobody_there_is_an_error_of_the_source() {
    let network = Network::new();
    let Err(error) = network.source() else { panic!("nobody is there") };
    assert!(matches!(error.kind(), ErrorKind::Source(SourceError::NoBoard(_))), "{error}");
    let said = error.to_string();
    assert!(
        said.starts_with("no network by ") && said.contains("client.json5: ") && !said.contains(".rs"),
        "{said}"
    );
    let router = network::open(NetworkEnd::Offer, Some(&network.router)).unwrap();
    let Err(error) = network.source() else { panic!("nobody offers it") };
    assert_eq!(error.to_string(), "zenoh:arm/left: nobody in the network offers this board");
    drop(router);
}

#[test]
#[cfg(target_os = "linux")]
fn nothing_listens_to_other_machines_unless_the_file_says_so() {
    let network = Network::new();
    let peer = folder().join("peer.json5");
    std::fs::write(&peer, "{ mode: \"peer\" }").unwrap();
    let sessions = [&network.router, &peer].map(|file| network::open(NetworkEnd::Offer, Some(file)).unwrap());
    let inodes = std::fs::read_dir("/proc/self/fd").unwrap().flatten();
    let inodes = inodes.filter_map(|entry| entry.path().read_link().ok()?.to_str().map(String::from));
    let ours: Vec<String> = inodes
        .filter_map(|link| Some(link.strip_prefix("socket:[")?.strip_suffix(']')?.to_string()))
        .collect();
    let mut listening = 0;
    for (table, state) in [("tcp", "0A"), ("tcp6", "0A"), ("udp", "07"), ("udp6", "07")] {
        let table = std::fs::read_to_string(format!("/proc/self/net/{table}")).unwrap_or_default();
        for row in table.lines().skip(1).map(|line| line.split_whitespace().collect::<Vec<_>>()) {
            if row[3] == state && ours.iter().any(|inode| inode == row[9]) {
                assert!(row[1].starts_with("0100007F:"), "{row:?}");
                listening += 1;
            }
        }
    }
    assert!(listening > 0, "the router listens on this machine");
    drop(sessions);
}
