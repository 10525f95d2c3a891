//! The schema of the robot's contacts is that of their struct. TAXEL_BLESS=1 updates the file.

use std::path::Path;
use taxel::robot::{ROBOT_CONTACTS, ROBOT_CONTACTS_SCHEMA, robot_contacts_schema};

#[test]
fn the_schema_of_the_robots_contacts_is_derived() {
    let [plain, _] = robot_contacts_schema();
    let want = format!("{}\n", serde_json::to_string_pretty(&plain).unwrap());
    if std::env::var_os("TAXEL_BLESS").is_some() {
        let file = format!("schemas/messages/{ROBOT_CONTACTS}.json");
        std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join(file), &want).unwrap();
    }
    assert!(ROBOT_CONTACTS_SCHEMA == want, "{ROBOT_CONTACTS}.json is not what TAXEL_BLESS=1 writes");
}
