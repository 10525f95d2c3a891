//! `taxel fcm new`: the four steps.

use taxel::fcm::map::MapFile;
use taxel_cli::commands::maps::new::Dialog;

const ANSWERS: &str = "press: how hard\nshape\nkindness: well meant\n\npress > kindness\nshape > kindness\n\n\
                       strong -\n0.9\ntanh\n-0.1\n\npress rise 0 30000\nhost 2 triangle 0 100 200\n";

fn asked(answers: &str, patient: bool) -> (Result<MapFile, String>, String) {
    let mut questions = Vec::new();
    let map = Dialog { answers: answers.as_bytes(), questions: &mut questions, patient, line: 0 }.map("mine");
    (map.map_err(|error| format!("{error:#}")), String::from_utf8(questions).unwrap())
}

#[test]
fn four_steps_make_a_map() {
    let (map, questions) = asked(ANSWERS, false);
    let map = map.unwrap();
    let wanted = "version = 1\nname = \"mine\"\nthreshold = -0.1\n\
        [[concept]]\nname = \"press\"\nnote = \"how hard\"\n[[concept]]\nname = \"shape\"\n[[concept]]\nname = \"kindness\"\nnote = \"well meant\"\n\
        [[input]]\nconcept = \"press\"\nsource = \"press\"\nrise = [0, 30000]\n\
        [[input]]\nconcept = \"shape\"\nsource = { host = 2 }\ntriangle = [0, 100, 200]\n\
        [[edge]]\nfrom = \"press\"\nto = \"kindness\"\nweight = \"strong -\"\n[[edge]]\nfrom = \"shape\"\nto = \"kindness\"\nweight = 0.9\n";
    assert_eq!(map, taxel::fcm::load::parse(wanted, "map.toml").unwrap());
    for step in ["1. Concepts", "2. Causes", "3. Weights", "4. Threshold", "press > kindness> "] {
        assert!(questions.contains(step), "{questions}");
    }
}

#[test]
fn a_bad_answer_is_refused_with_its_line_or_asked_for_again() {
    for (good, bad, message) in [
        ("shape\n", "press\n", "line 2: concept press is named twice"),
        ("press > kindness", "press - kindness", "line 5: expected CAUSE > EFFECT"),
        ("press > kindness", "force > kindness", "line 5: force is not a concept"),
        ("strong -", "strongly", "line 8: \"strongly\" is neither a number in -1 ..= 1 nor a term"),
        ("0.9", "1.9", "line 9: \"1.9\" is neither a number in -1 ..= 1 nor a term"),
        ("tanh", "relu", "line 10: expected bivalent, trivalent, sigmoid, tanh or positive"),
        ("-0.1", "7", "line 11: expected a number in -1 ..= 1"),
        (
            "rise 0 30000",
            "rise 0",
            "line 13: expected rise A B, fall A B, triangle A B C or trapezoid A B C D",
        ),
        ("press rise", "weight rise", "line 13: weight is not a source"),
        ("0 100 200\n", "0 200 100\n", "line 14: input shape: the points [0, 200, 200, 100] do not rise"),
    ] {
        let (refused, _) = asked(&ANSWERS.replacen(good, bad, 1), false);
        let refused = refused.unwrap_err();
        assert!(refused.starts_with(message), "{refused}");
    }
    // In a dialogue, the error is shown and the question repeated.
    let (map, said) = asked(&ANSWERS.replacen("strong -", "strongly\nstrong -", 1), true);
    assert_eq!(map, asked(ANSWERS, false).0);
    assert!(
        said.contains("\"strongly\" is neither a number in -1 ..= 1 nor a term\npress > kindness> "),
        "{said}"
    );
    let cut = asked(&ANSWERS[..40], false).0.unwrap_err();
    assert!(cut.ends_with("the answers end before the map is complete"), "{cut}");
}
