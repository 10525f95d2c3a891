//! Meshes that a URDF names for a link: where they are sought, scaled and placed, and what is refused.

use std::path::{Path, PathBuf};
use taxel::body::DVec3;
use taxel::body::mesh::of_link;
use taxel::body::robot::LinkShape;
use taxel::error::{ErrorKind, RobotError};

/// A folder of packages: `arm/urdf/arm.urdf`, and meshes in two packages.
struct Packages(PathBuf);

impl Packages {
    fn new(name: &str, link: &str) -> Packages {
        let folder =
            Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("link-{name}-{}", std::process::id()));
        for inner in ["arm/urdf", "arm/meshes", "skin"] {
            std::fs::create_dir_all(folder.join(inner)).unwrap();
        }
        let board = "v 0 -100 -100\nv 0 100 -100\nv 0 100 100\nv 0 -100 100\nf 1 2 3 4\n";
        for file in ["arm/meshes/board.obj", "arm/urdf/board.obj", "skin/board.obj"] {
            std::fs::write(folder.join(file), board).unwrap();
        }
        std::fs::write(folder.join("skin/holed.obj"), "v 0 0 0\nf 1 2 3\n").unwrap();
        let urdf = format!(
            "<robot name=\"arm\">\n<link name=\"hand\"/>\n<link name=\"arm\">\n{link}\n</link>\n</robot>\n"
        );
        std::fs::write(folder.join("arm/urdf/arm.urdf"), urdf).unwrap();
        Packages(folder)
    }

    fn urdf(&self) -> String {
        self.0.join("arm/urdf/arm.urdf").to_str().unwrap().into()
    }
}

impl Drop for Packages {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn shape(tag: &str, origin: &str, file: &str) -> String {
    format!(
        "<{tag}>{origin}<geometry><mesh filename=\"{file}\" scale=\"0.001 0.001 0.002\"/></geometry></{tag}>"
    )
}

/// The board of 20 cm by 40 cm stands at x = 0.3 m, turned by a quarter about z.
#[test]
fn a_mesh_is_sought_scaled_and_placed_as_the_urdf_says() {
    let origin = "<origin xyz=\"0.3 0 0.1\" rpy=\"0 0 1.5707963267948966\"/>";
    let packages = [("skin".to_string(), PathBuf::new())];
    for (number, file) in
        ["board.obj", "../meshes/board.obj", "package://arm/meshes/board.obj", "package://skin/board.obj"]
            .into_iter()
            .enumerate()
    {
        let tree = Packages::new(&format!("found-{number}"), &shape("visual", origin, file));
        // Named, or beside the package of the robot.
        for package in [&packages[..0], &[("skin".to_string(), tree.0.join("skin"))]] {
            let found = of_link(&tree.urdf(), "arm", LinkShape::Visual, package).unwrap();
            assert!(found.files.len() == 1 && found.files[0].ends_with(file.rsplit('/').next().unwrap()));
            let [least, most] =
                [DVec3::min, DVec3::max].map(|of| found.mesh.points().iter().copied().reduce(of).unwrap());
            assert!(least.abs_diff_eq(DVec3::new(0.2, 0.0, -0.1), 1e-12), "{least}");
            assert!(most.abs_diff_eq(DVec3::new(0.4, 0.0, 0.3), 1e-12), "{most}");
        }
    }
    // By its whole path; and a link of several parts.
    let whole = Packages::new("whole", "");
    let path = format!("file://{}", whole.0.join("skin/board.obj").display());
    let tree = Packages::new("parts", &(shape("visual", origin, &path) + &shape("visual", "", "board.obj")));
    let found = of_link(&tree.urdf(), "arm", LinkShape::Visual, &[]).unwrap();
    assert_eq!((found.files.len(), found.mesh.triangles().len()), (2, 4));
}

#[test]
fn meshes_that_are_not_there_are_reported_with_file_line_and_link() {
    let why = |link: &str, name: &str| {
        let tree = Packages::new("wrong", link);
        let error = of_link(&tree.urdf(), name, LinkShape::Visual, &[]).unwrap_err();
        assert!(!matches!(error.kind(), ErrorKind::Usage(_)));
        format!("{error:#}").replace(tree.0.to_str().unwrap(), "")
    };
    let file = "/arm/urdf/arm.urdf, line 4, link \"arm\": ";
    assert_eq!(
        why(&shape("visual", "", "package://cloth/a.obj"), "arm"),
        format!(
            "{file}mesh package://cloth/a.obj: no folder above the file has a package \"cloth\" with it; say where the package is"
        )
    );
    assert_eq!(
        why(&shape("visual", "", "package://cloth"), "arm"),
        format!("{file}mesh package://cloth: must be package://NAME/PATH")
    );
    let missing = why(&shape("visual", "", "none.stl"), "arm");
    assert!(missing.starts_with(&format!("{file}cannot read /arm/urdf/none.stl: ")), "{missing}");
    let bad = why(&shape("visual", "", "package://skin/holed.obj"), "arm");
    assert_eq!(bad, format!("{file}/skin/holed.obj, line 2: there is no point 2 among the 1 above"));
    let unread = why(&shape("visual", "", "../urdf/arm.urdf"), "arm");
    assert!(unread.ends_with("arm.urdf: meshes are read from .stl and .obj files"), "{unread}");
    let scale = shape("visual", "", "board.obj").replace("0.002", "0");
    assert_eq!(why(&scale, "arm"), format!("{file}`scale` of <mesh> must not have a 0"));
    let nan = shape("visual", "", "board.obj").replace("0.002", "nan");
    assert!(why(&nan, "arm").starts_with(&format!("{file}`scale` of <mesh> must be three numbers")));
    assert_eq!(why("<visual/>", "arm"), format!("{file}lacks <geometry>"));
    let none = "/arm/urdf/arm.urdf, line 3, link \"arm\": has no mesh in a <visual>; ";
    assert_eq!(
        why("", "arm"),
        format!("{none}on boxes, cylinders and spheres, panels lie by `on.plane` and `on.cylinder`")
    );
    assert_eq!(why(&shape("collision", "", "board.obj"), "arm"), format!("{none}its <collision> has one"));
    let tree = Packages::new("unknown", "");
    let error = of_link(&tree.urdf(), "hnd", LinkShape::Collision, &[]).unwrap_err();
    assert!(
        matches!(error.kind(), ErrorKind::Robot(RobotError::NoLink { link, .. }) if link == "hnd"),
        "{error}"
    );
    assert!(
        error.to_string().ends_with("there is no link \"hnd\": did you mean \"hand\"? Known are hand, arm")
    );
}
