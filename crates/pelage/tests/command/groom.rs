//! A folder with a groom in it, and the command to run on it.

use pelage::StrandBuffer;
use pelage::io::{read_curves, read_obj_mesh, strands_through_vertices};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use tempfile::TempDir;

/// A folder of its own for a test.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    /// A folder with the example `ball`.
    pub fn with_ball() -> Self {
        let folder = Self::new();
        let ball = pelage::examples::example("ball").unwrap();
        pelage::examples::write(&ball, folder.0.path()).unwrap();
        folder
    }

    pub fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }

    pub fn exists(&self, name: &str) -> bool {
        Path::new(&self.path(name)).exists()
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// Puts a line under a section of the recipe.
    pub fn add_to_recipe(&self, section: &str, line: &str) {
        let text = String::from_utf8(self.bytes("groom.toml")).unwrap();
        assert!(text.contains(section), "{text}");
        self.write(
            "groom.toml",
            &text.replacen(section, &format!("{section}\n{line}"), 1),
        );
    }

    /// Copies a map of the ball.
    pub fn copy_ball_map(&self, name: &str) {
        let ball = Self::with_ball();
        std::fs::write(self.path(name), ball.bytes(name)).unwrap();
    }

    /// Writes the ball, moved along x.
    pub fn pose(&self, name: &str, shift: f32) {
        let mesh = read_obj_mesh(self.path("ball.obj").as_ref()).unwrap();
        let mut text = String::new();
        for [x, y, z] in mesh.positions {
            text += &format!("v {} {y} {z}\n", x + shift);
        }
        let mut corners = mesh.corner_vertices.iter();
        for size in mesh.face_sizes {
            text += "f";
            corners
                .by_ref()
                .take(size as usize)
                .for_each(|v| text += &format!(" {}", v + 1));
            text += "\n";
        }
        self.write(name, &text);
    }

    /// Runs `pelage generate` into `name`.
    pub fn generate(&self, name: &str, more: &[&str]) -> String {
        let (recipe, output) = (self.path("groom.toml"), self.path(name));
        let output = if name == "null" { name } else { &output };
        pelage(&[&["generate", &recipe, "-o", output], more].concat())
    }

    /// The strands that `pelage generate` writes into `name`.
    pub fn arrays(&self, name: &str, more: &[&str]) -> StrandBuffer {
        self.generate(name, more);
        let file = read_curves(self.path(name).as_ref(), None).unwrap();
        strands_through_vertices(&file.sets[0])
    }
}

/// Starts the command without waiting for it.
pub fn start(arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pelage"));
    command
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.spawn().unwrap()
}

/// Runs the command, whatever comes of it.
pub fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pelage"))
        .args(arguments)
        .output()
        .unwrap()
}

/// Runs the command; it must succeed. Gives what it printed.
pub fn pelage(arguments: &[&str]) -> String {
    let output = run(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Runs the command; it must fail with words and without a panic. Gives the words.
pub fn fails(arguments: &[&str]) -> String {
    let output = run(arguments);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success(), "{arguments:?} went through");
    assert!(
        errors.starts_with("error: ") && !errors.contains("panicked"),
        "{errors}"
    );
    errors
}
