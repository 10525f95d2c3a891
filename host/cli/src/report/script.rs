//! Modules of the page as one script, for a page that loads no files.

/// Modules in the order of their imports.
const MODULES: [(&str, &str); 16] = [
    ("dom", include_str!("../view/page/dom.js")),
    ("colours", include_str!("../view/page/colours.js")),
    ("garment", include_str!("../view/page/garment.js")),
    ("camera", include_str!("../view/page/camera.js")),
    ("mesh", include_str!("../view/page/mesh.js")),
    ("axes", include_str!("../view/page/axes.js")),
    ("relief-gl", include_str!("../view/page/relief-gl.js")),
    ("relief-flat", include_str!("../view/page/relief-flat.js")),
    ("drawing", include_str!("../view/page/drawing.js")),
    ("orbit", include_str!("../view/page/orbit.js")),
    ("relief", include_str!("../view/page/relief.js")),
    ("figure", include_str!("../view/page/figure.js")),
    ("cloth", include_str!("../view/page/cloth.js")),
    ("robot-marks", include_str!("../view/page/robot-marks.js")),
    ("on-robot", include_str!("../view/page/on-robot.js")),
    ("frozen", include_str!("frozen.js")),
];

/// All modules, each in a function of its own that returns what it exports.
pub fn bundle() -> String {
    MODULES.iter().map(|(name, text)| wrapped(name, text)).collect()
}

fn wrapped(name: &str, text: &str) -> String {
    let mut exports = Vec::new();
    let mut body = String::new();
    for line in text.lines().filter(|line| !is_comment(line)) {
        if let Some((names, from)) = imported(line) {
            body += &format!("const {names} = {};\n", variable(from));
            continue;
        }
        let rest = line.strip_prefix("export ");
        exports.extend(rest.and_then(declared));
        body += rest.unwrap_or(line);
        body.push('\n');
    }
    format!("const {} = (() => {{\n{body}return {{ {} }};\n}})();\n", variable(name), exports.join(", "))
}

/// Variable of a module.
fn variable(name: &str) -> String {
    format!("${}", name.replace('-', "_"))
}

/// `{ names }` and module of an import.
fn imported(line: &str) -> Option<(&str, &str)> {
    let (names, from) = line.strip_prefix("import ")?.split_once(" from \"")?;
    let file = from.rsplit('/').next()?;
    Some((names, file.strip_suffix(".js\";")?))
}

/// Name of what a line declares.
fn declared(line: &str) -> Option<&str> {
    let mut words =
        line.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '$').filter(|w| !w.is_empty());
    let kinds = ["async", "function", "class", "const"];
    words.find(|word| !kinds.contains(word))
}

fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    ["//", "/**", "* ", "*/"].iter().any(|start| line.starts_with(start)) || line == "*"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn modules_become_functions() {
        let module = "// What.\nimport { a, b } from \"./relief-gl.js\";\n\n/** How. */\nexport const c = (x) => a(x);\n\
                      export async function d() {}\nexport class E {}\n";
        assert_eq!(
            wrapped("f", module),
            "const $f = (() => {\nconst { a, b } = $relief_gl;\n\nconst c = (x) => a(x);\nasync function d() {}\n\
             class E {}\nreturn { c, d, E };\n})();\n"
        );
    }

    #[test]
    fn every_import_is_of_a_module_before() {
        let script = bundle();
        assert!(!script.contains("import ") && !script.contains("export ") && !script.contains("</"));
        let known: Vec<_> = MODULES.iter().map(|(name, _)| *name).collect();
        for (at, (name, text)) in MODULES.iter().enumerate() {
            // A line with a comment at its beginning is left out: nothing else stands there.
            for line in text.lines().filter(|line| line.trim_start().starts_with("/*")) {
                assert!(!line.contains("*/") || line.trim_end().ends_with("*/"), "{name}: {line}");
            }
            for (_, from) in text.lines().filter_map(imported) {
                assert!(known[..at].contains(&from), "{name} imports {from}");
            }
        }
    }
}
