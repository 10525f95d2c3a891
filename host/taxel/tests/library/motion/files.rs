//! Behaviours' files: what is wrong is named by file, line and key.

use taxel::body::robot;
use taxel::motion::Behaviour;

fn refused(text: &str) -> String {
    let robot = robot::read("reference").unwrap();
    format!("{:#}", Behaviour::parse("b.toml", text, &robot).unwrap_err())
}

#[test]
fn errors_name_line_and_key() {
    for (text, why) in [
        ("", "b.toml, line 1: `name` is missing"),
        ("name = \"x\"\nspeed = 3\n", "b.toml, line 2: `speed` is not a known key"),
        ("name = \"x\"\n[retreat]\nspeed = 9\n", "b.toml, line 3, `retreat.speed`: must be 0.01 to 2, not 9"),
        (
            "name = \"x\"\n[yield]\nafter_s = 0.1\n",
            "b.toml, line 3, `yield.after_s`: must be 0.3 to 60, not 0.1",
        ),
        ("name = \"x\"\ntank_j = nan\n", "b.toml, line 2, `tank_j`: must be 0 to 100, not NaN"),
        (
            "name = \"x\"\n[joint.elbow]\nmoves = false\n",
            "b.toml, line 2, `joint.elbow`: there is no joint \"elbow\"",
        ),
        (
            "name = \"x\"\n[joint.waist]\nvelocity = -1\n",
            "b.toml, line 3, `joint.waist.velocity`: must be 0 to 20, not -1",
        ),
        (
            "name = \"x\"\n[[when]]\ndo = \"slow\"\n",
            "b.toml, line 2, `when[0].factor`: `slow` needs a factor, 0 to 1",
        ),
        (
            "name = \"x\"\n[[when]]\ndo = \"stop\"\nfactor = 0.5\n",
            "b.toml, line 4, `when[0].factor`: only `slow` has a factor",
        ),
        (
            "name = \"x\"\n[[when]]\ndo = \"flee\"\n",
            "b.toml, line 3, `do`: `flee` is not a known name: `stop`, `retreat`, `yield`, `slow`, `ignore`",
        ),
        (
            "name = \"x\"\n[[limits]]\nnewtons = 30\nsource = \"\"\n",
            "b.toml, line 4, `limits[0].source`: says where the limit comes from",
        ),
        (
            "name = \"x\"\n[[apart]]\nlinks = [\"torso\", \"leg\"]\nmetres = 0.1\n",
            "b.toml, line 3, `apart[0].links`:",
        ),
    ] {
        let said = refused(text);
        assert!(said.starts_with(why), "{text}\n{said}\n{why}");
    }
}

#[test]
fn the_shipped_behaviour_fits_the_shipped_robot() {
    let robot = robot::read("reference").unwrap();
    let people = Behaviour::read("people", &robot).unwrap();
    assert_eq!(people.joints.len(), robot.free().len());
    assert!(people.config.limits.iter().all(|limit| limit.source.starts_with("doi:10.")));
    // The waist is as slow as the URDF says, or slower.
    assert!(people.joints.iter().all(|joint| joint.velocity <= 1.5 && joint.positions.is_some()));
    let unknown = format!("{:#}", Behaviour::read("poeple", &robot).unwrap_err());
    assert!(unknown.contains("did you mean \"people\""), "{unknown}");
}
