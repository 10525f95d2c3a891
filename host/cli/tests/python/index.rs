//! The table of `taxel index`, asked the same by DuckDB and by Polars.

use super::read;
use super::stage::file;
use super::start::taxel;
use serde_json::{Value, json};
use std::process::Command;

#[test]
fn duckdb_and_polars_say_the_same_of_a_table() {
    let folder = file("index");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(folder.join("deep")).unwrap();
    let run = |words: &str| {
        let done = Command::new(taxel()).args(words.split(' ')).current_dir(&folder).output().unwrap();
        assert!(done.status.success(), "{words}: {}", String::from_utf8_lossy(&done.stderr));
    };
    for (scene, garment, name) in [
        ("lash", "reference", "lash.mcap"),
        ("pat", "reference", "deep/pat.mcap"),
        ("press", "block-4x16", "press.mcap"),
    ] {
        run(&format!("record --source sim:{scene} --garment {garment} -o {name}"));
    }
    std::fs::write(folder.join("broken.mcap"), "no recording").unwrap();
    run("index . -o index.parquet");
    let table = folder.join("index.parquet");
    let [duckdb, polars] = ["duckdb", "polars"].map(|how| read(how, &table));
    assert_eq!(duckdb, polars);
    // Garment, boards, frames, contacts, attacks, their time and their begin (us), and what cannot be read.
    let rows = duckdb.as_array().unwrap();
    let garments: Vec<[&Value; 2]> = rows.iter().map(|row| [&row[0], &row[1]]).collect();
    assert_eq!(json!(garments), json!([[null, 1], ["block-4x16", 1], ["reference", 2]]));
    assert_eq!(json!(rows[0].as_array().unwrap()[2..]), json!([0, 0, 0, 0, null, 1]));
    for row in &rows[1..] {
        let number = |at: usize| row[at].as_u64().unwrap();
        assert!(number(2) > 300 && number(3) > 0 && number(5) > 1_000_000, "{row}");
        assert!(number(6) > 1_700_000_000_000_000 && number(7) == 0, "{row}");
    }
    assert!(rows[2][4].as_u64().unwrap() > 0);
    println!("DuckDB and Polars read {} rows of an index as they were", rows.len());
}
