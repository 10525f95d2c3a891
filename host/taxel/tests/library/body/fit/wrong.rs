//! Touches that do not say how a garment sits, files that are wrong, and the file that is written.

use super::displaced::{Case, cases, known, read, read_again};
use taxel::body::fit::{FeltTouch, KnownTouch, Mark, known_touches, marks, picked};
use taxel::body::{DVec3, PatchOffset, Surface};

/// Places of a mat, (column, row), touched on a body of this name that sits 7 mm farther to the right.
fn touched(name: &str, at: &[(f64, f64)]) -> (Case, Surface, Vec<KnownTouch>) {
    let case = cases().into_iter().find(|case| case.name == name).unwrap();
    let truly = read_again(&case, &[PatchOffset { right: 0.007, down: 0.0, turn: 2.0 }]);
    let layout = case.layout();
    let touch = |(x, y): &(f64, f64)| {
        let felt = FeltTouch { panel: 0, x: *x, y: *y };
        known(&truly, &layout, felt, truly.at(&layout, 0, *x, *y).unwrap().at)
    };
    let touches = at.iter().map(touch).collect();
    (case, truly, touches)
}

/// Of a line of touches the turn is known: each is known in both directions of the surface.
#[test]
fn touches_on_one_line_say_all_three() {
    for name in ["plane", "cylinder", "grid", "list"] {
        let (case, _, touches) = touched(name, &[(3.0, 10.0), (9.0, 10.0), (15.0, 10.0), (22.0, 10.0)]);
        let fit = read(&case, "line", &[]).fit(&case.garment, &case.layout(), &touches).unwrap();
        let offsets = fit.panels[0].offset;
        assert!(
            (offsets.right - 0.007).abs() < 1e-5 && (offsets.turn - 2.0).abs() < 1e-2,
            "{name}: {offsets:?}"
        );
    }
}

/// Touches on one spot say the shift alone: the turn is that of the file, and is not claimed.
#[test]
fn touches_on_one_spot_do_not_say_the_turn() {
    let spot = [(15.0, 31.0), (15.5, 31.5), (16.0, 32.0), (15.2, 31.9)];
    let (case, _, touches) = touched("plane", &spot);
    let turned = PatchOffset { turn: 2.0, ..PatchOffset::default() };
    for (before, right) in [(turned, 7.0), (PatchOffset::default(), 7.0)] {
        let fit = read(&case, "spot", &[before]).fit(&case.garment, &case.layout(), &touches).unwrap();
        let panel = &fit.panels[0];
        assert_eq!((panel.turn_sd, panel.offset.turn), (None, before.turn));
        assert!((panel.offset.right * 1e3 - right).abs() < 0.3, "{panel:?}");
    }
}

#[test]
fn touches_that_say_nothing_are_reported() {
    let corners = [(3.0, 10.0), (9.0, 50.0), (15.0, 33.0), (22.0, 10.0), (28.0, 60.0), (5.0, 40.0)];
    let (case, _, touches) = touched("plane", &corners);
    let (read, layout) = (read(&case, "nothing", &[]), case.layout());
    let of = |touches: &[KnownTouch]| read.fit(&case.garment, &layout, touches);
    let why = |touches: &[KnownTouch]| of(touches).unwrap_err().to_string();
    let few = of(&touches[..2]).unwrap();
    assert_eq!((few.panels.len(), few.few), (0, vec![("mat".into(), 2)]));
    assert_eq!(of(&[]).unwrap().few, []);
    let change = |change: &dyn Fn(usize, &mut KnownTouch)| {
        let mut touches = touches.clone();
        touches.iter_mut().enumerate().for_each(|(number, touch)| change(number, touch));
        touches
    };
    let disagree = change(&|number, touch| touch.x += 0.05 * (number * number % 5) as f64);
    assert_eq!(
        why(&disagree),
        "panel mat: its 6 touches do not agree: no placing brings more than half of them within 20 mm"
    );
    let elsewhere = change(&|_, touch| touch.link = "hand".into());
    assert_eq!(why(&elsewhere), why(&disagree));
    let above = change(&|_, touch| touch.z += 0.1);
    assert_eq!(why(&above), why(&disagree));
    let unknown = change(&|_, touch| touch.panel = "mad".into());
    assert_eq!(why(&unknown), "touch 1: the garment has no panel \"mad\"; known are mat");
    let far = change(&|number, touch| touch.column += 90.0 * f64::from(u8::from(number == 2)));
    assert_eq!(why(&far), "touch 3: column 105, row 33 is far beside panel mat");
}

#[test]
fn files_of_touches_and_marks_are_read_or_reported() {
    let head = "panel,column,row,link,x,y,z\n";
    let one = known_touches("t.csv", &format!("{head}left arm, 3.5, 7, torso, 0.1, 0, -0.2\n")).unwrap();
    assert_eq!(
        (one[0].panel.as_str(), one[0].column, one[0].at()),
        ("left arm", 3.5, DVec3::new(0.1, 0.0, -0.2))
    );
    let why = |text: &str| known_touches("t.csv", text).unwrap_err().to_string();
    assert_eq!(
        why(&format!("{head}a,1,2,torso,0,0,0\na,b,2,torso,0,0,0\n")),
        "t.csv, line 3: `column`: invalid float literal"
    );
    assert_eq!(why(&format!("{head}a,1\n")), "t.csv, line 2: 2 values, and the heading has 7");
    assert_eq!(why(&format!("{head}a,nan,2,torso,0,0,0\n")), "t.csv, touch 1: not finite");
    assert!(why("panel,column\na,1\n").starts_with("t.csv, line 2: "));
    let list = marks("m.txt", "# left\ntorso 0.1 0 0.2\n\nhand,1,2,3\n").unwrap();
    assert_eq!(list[0], Mark { link: "torso".into(), at: DVec3::new(0.1, 0.0, 0.2) });
    assert_eq!((list.len(), list[1].link.as_str()), (2, "hand"));
    let why = |text: &str| marks("m.txt", text).unwrap_err().to_string();
    for text in ["torso 1 2", "torso 1 2 x", "torso 1 2 inf", "torso 1 2 3 4"] {
        assert_eq!(
            why(&format!("\n{text}")),
            format!("m.txt, line 2: not a link and three numbers: {text:?}")
        );
    }
}

/// Marks are picked inside each panel, apart from each other.
#[test]
fn marks_are_picked_where_a_finger_is_felt_as_a_whole() {
    let case = &cases()[0];
    let surface = read_again(case, &[]);
    let all = picked(&surface, &case.layout(), 5);
    assert_eq!(all.len(), 20);
    for (number, mark) in all.iter().enumerate() {
        let place = surface.places().iter().flatten().position(|place| place.at == mark.at).unwrap();
        let (row, column) = (place % 512 / 16, place % 16);
        assert_eq!(place / 512, number / 5);
        assert!((2..30).contains(&row) && (2..14).contains(&column), "{row} {column}");
        let apart =
            |other: &Mark| other == mark || other.link != mark.link || other.at.distance(mark.at) > 0.05;
        assert!(all.iter().all(apart));
    }
    assert!(picked(&surface, &case.layout(), 0).is_empty());
    assert_eq!(picked(&surface, &case.layout(), 10_000).len(), 4 * 28 * 12);
}

/// The file that is written has the author's comments, and says how the panel sits.
#[test]
fn the_body_file_keeps_its_comments() {
    let (mut case, truly, touches) =
        touched("plane", &[(3.0, 10.0), (9.0, 50.0), (15.0, 33.0), (22.0, 10.0)]);
    case.body = format!("# mine\n{}# the end\n", case.body.replace("\non", "   # flat\non"));
    let body = read(&case, "comments", &[]);
    let fit = body.fit(&case.garment, &case.layout(), &touches).unwrap();
    let text = body.with_offsets(&fit.panels).unwrap();
    let line = "\noffset = { right = 0.007, down = 0.0, turn = 2.0 }\n";
    assert_eq!(text.replace(line, "\n"), case.body);
    case.body = text;
    let written = read_again(&case, &[]);
    for (one, other) in written.places().iter().zip(truly.places()) {
        assert!(one.unwrap().at.distance(other.unwrap().at) < 1e-5);
    }
    // Patches may be written as a list.
    case.body = "patches = [{ panel = \"mat\", on.plane = { at = [0.4, -0.2, 1.1], normal = [1, 2, 3], down = [0, -3, 2] } }]".into();
    let text = read(&case, "list", &[]).with_offsets(&fit.panels).unwrap();
    assert!(text.contains("offset = { right = 0.007, down = 0.0, turn = 2.0 }"), "{text}");
}

#[test]
fn offsets_must_be_numbers_and_on_one_side() {
    let why = |name: &str, offsets: PatchOffset| {
        let case = cases().into_iter().find(|case| case.name == name).unwrap();
        let surface = read(&case, "numbers", &[offsets]).surface(&case.garment, &case.layout());
        format!("{:#}", surface.unwrap_err()).split("body.toml").last().unwrap().to_string()
    };
    let nan = PatchOffset { down: f64::INFINITY, ..PatchOffset::default() };
    assert_eq!(why("plane", nan), ", line 2, `patches[0].offset.down`: must be a number");
    let mut around = cases().into_iter().find(|case| case.name == "grid").unwrap();
    let point = |z: f64, angle: f64| format!("[{:.3}, {:.3}, {z}]", 0.1 * angle.cos(), 0.1 * angle.sin());
    let row = |z: f64| {
        format!("[{}]", (0..9).map(|step| point(z, f64::from(step) * 0.75)).collect::<Vec<_>>().join(", "))
    };
    around.body =
        format!("[[patches]]\npanel = \"mat\"\non.grid = {{ points = [{}, {}] }}\n", row(0.6), row(0.0));
    assert!(read(&around, "round", &[]).surface(&around.garment, &around.layout()).is_ok());
    let shifted = read(&around, "round", &[PatchOffset { right: 0.01, ..PatchOffset::default() }]);
    let why = format!("{:#}", shifted.surface(&around.garment, &around.layout()).unwrap_err());
    let end = ", line 2, `patches[0].offset`: needs taxels on one side of the robot: these have no plane that touches them";
    assert!(why.ends_with(end), "{why}");
}
