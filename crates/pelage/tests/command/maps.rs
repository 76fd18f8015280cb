//! Maps as users have them: good ones of every kind, and bad ones.

use crate::groom::{Folder, fails, run};
use pelage::io::{PngCodes, write_exr, write_png};

/// A square of two triangles whose texture is twice as wide as a tile.
const TWO_TILES: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n\
    vt 0 0\nvt 2 0\nvt 2 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

impl Folder {
    /// A square with `lines` in its recipe.
    fn with_square(lines: &str) -> Self {
        let folder = Self::new();
        folder.write("square.obj", TWO_TILES);
        folder.recipe(lines);
        folder
    }

    fn recipe(&self, lines: &str) {
        self.write(
            "groom.toml",
            &format!(
                "{lines}\nsurface.mesh = 'square.obj'\nhair.count = 2000\n\
                 guides.grow.count = 20\nguides.grow.length = 0.1\n"
            ),
        );
    }

    fn exr(&self, name: &str, channels: u32, numbers: &[f32]) {
        let width = numbers.len() as u32 / 2 / channels;
        write_exr(self.path(name).as_ref(), width, 2, channels, numbers).unwrap();
    }

    fn grey(&self, name: &str, codes: &[u8]) {
        let width = codes.len() as u32;
        write_png(
            self.path(name).as_ref(),
            width,
            1,
            1,
            PngCodes::Eight(codes),
        )
        .unwrap();
    }

    /// What `pelage generate` says of the failure, without the folder's name.
    fn refusal(&self) -> String {
        let words = fails(&["generate", &self.path("groom.toml"), "-o", "null"]);
        words.replace(&self.path(""), "")
    }

    /// What a run that goes through has to remark.
    fn notes(&self) -> String {
        let output = run(&["generate", &self.path("groom.toml"), "-o", "null"]);
        let words = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{words}");
        words
    }
}

#[test]
fn a_texel_that_is_no_density_is_named_with_its_key_file_place_channel_and_remedy() {
    for (bad, said) in [
        (f32::NAN, "NaN"),
        (f32::INFINITY, "inf"),
        (f32::NEG_INFINITY, "-inf"),
    ] {
        let folder = Folder::with_square("roots.density = { map = 'fur.exr', channel = 'g' }");
        let mut numbers = [0.5; 18];
        numbers[13] = bad;
        folder.exr("fur.exr", 3, &numbers);
        let expected = format!(
            "error: groom.toml:1:17: roots.density: fur.exr: texel (column 1, row 1 from the \
             top, channel 1, counted from 0) is {said}; maps must be finite: paint over it\n  \
             |\n1 | roots.density = {{ map = 'fur.exr', channel = 'g' }}\n  \
             |                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\n"
        );
        assert_eq!(folder.refusal(), expected);
    }
    let folder = Folder::with_square("roots.density = { map = 'fur.exr', channel = 'g' }");
    let mut numbers = [0.5; 18];
    numbers[16] = -0.25;
    folder.exr("fur.exr", 3, &numbers);
    assert_eq!(
        folder.refusal(),
        "error: groom.toml:1:17: roots.density: fur.exr: texel (column 2, row 1 from the top, \
         counted from 0), channel g, is -0.25; a density must be at least 0: paint it 0 or \
         more, or read another channel\n  \
         |\n1 | roots.density = { map = 'fur.exr', channel = 'g' }\n  \
         |                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\n"
    );
}

#[test]
fn a_map_that_cannot_be_read_is_named_with_its_key() {
    let folder = Folder::with_square("scale.amount = { map = 'length.png' }");
    let says = |words: &str| {
        let found = folder.refusal();
        assert!(found.contains("groom.toml:1:"), "{found}");
        assert!(found.contains("scale.amount: length.png: "), "{found}");
        assert!(found.contains(words), "{found}");
    };
    says("No such file");
    folder.grey("whole.png", &[7; 3000]);
    let whole = folder.bytes("whole.png");
    for length in [0, 20, 40, whole.len() - 20] {
        std::fs::write(folder.path("length.png"), &whole[..length]).unwrap();
        says("");
    }
    folder.write("length.png", "a picture of a horse");
    says("not an image that is read here: PNG, JPEG, TIFF, HDR or EXR");
    std::fs::remove_file(folder.path("length.png")).unwrap();
    std::fs::create_dir(folder.path("length.png")).unwrap();
    says("this is a folder, not a file");
}

#[test]
fn bits_of_a_map_do_not_matter_where_its_values_are_the_same() {
    let folder = Folder::with_square("roots.density = { map = 'fur.png' }");
    folder.grey("fur.png", &[0, 255, 255, 0]);
    let hair = folder.arrays("hair.npz", &[]);
    let codes = [0, u16::MAX, u16::MAX, 0];
    let path = folder.path("fur.png");
    write_png(path.as_ref(), 4, 1, 1, PngCodes::Sixteen(&codes)).unwrap();
    assert!(folder.arrays("sixteen.npz", &[]) == hair);
    // A format is told by its first bytes, not by its name.
    folder.exr("fur.png", 1, &[0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0]);
    assert!(folder.arrays("float.npz", &[]).root_uv == hair.root_uv);
}

#[test]
fn a_black_map_gives_no_hair_and_says_so() {
    let folder = Folder::with_square("roots.density = { map = 'fur.png' }");
    folder.grey("fur.png", &[0; 16]);
    assert!(
        folder
            .notes()
            .contains("roots.density is 0 on the whole surface: no hair can grow")
    );
    assert!(folder.generate("null", &[]).starts_with("0 hairs"));
    assert!(folder.arrays("none.npz", &[]).is_empty());
}

#[test]
fn peaks_of_a_million_take_the_hairs_they_are_due() {
    let folder = Folder::with_square("roots.density = { map = 'fur.exr' }");
    let mut numbers = [1.0; 128];
    numbers[17] = 1e6;
    folder.exr("fur.exr", 1, &numbers);
    let hair = folder.arrays("hair.npz", &[]);
    // Column 17 of 64, the upper row, on both of the tiles that repeat.
    let near = |uv: &[f32; 2]| (uv[0].fract() * 64.0 - 17.5).abs() < 3.0;
    let at_peak = hair.root_uv.iter().filter(|uv| near(uv)).count();
    assert!(at_peak > 1990, "{at_peak}");
}

#[test]
fn a_set_of_tiles_is_found_in_its_folder_and_read_by_every_kind_of_property() {
    let folder = Folder::with_square(
        "roots.density = { map = 'fur.<UDIM>.png' }\n\
         color.root = { map = 'color.<UDIM>.png' }\n\
         width.root = { map = 'width.<UDIM>.exr' }\n\
         groups = { map = 'group.<UDIM>.png', segments = { '#000000' = 3, '#ffffff' = 5 } }\n\
         guides.grow.comb = { map = 'comb.<UDIM>.exr' }",
    );
    let rgb = |name: &str, codes: [u8; 3]| {
        write_png(folder.path(name).as_ref(), 1, 1, 3, PngCodes::Eight(&codes)).unwrap();
    };
    for (number, shade) in [(1001, 0.25), (1002, 0.5)] {
        folder.grey(&format!("fur.{number}.png"), &[255; 5]);
        rgb(
            &format!("color.{number}.png"),
            [0, (number % 2) as u8 * 255, 255],
        );
        folder.exr(&format!("width.{number}.exr"), 1, &[shade; 8]);
        folder.exr(&format!("comb.{number}.exr"), 3, &[1.0; 12]);
    }
    rgb("group.1001.png", [0; 3]);
    rgb("group.1002.png", [250; 3]);
    // Neither is a tile.
    folder.write("fur.12.png", "");
    folder.write("fur.1002.png.txt", "");
    assert_eq!(folder.notes(), "");
    let hair = folder.arrays("hair.npz", &[]);
    let mut seen = [0; 2];
    for i in 0..hair.len() {
        let tile = usize::from(hair.root_uv[i][0] >= 1.0);
        seen[tile] += 1;
        assert_eq!(hair.group[i] as usize, tile);
        assert_eq!(hair.strand_points(i).len(), [4, 6][tile]);
        let first = hair.offsets[i] as usize;
        // Of two images of one size, a texel of each mixes between their middles.
        let width = hair.widths[first];
        assert!((0.25..=0.5).contains(&width), "{width}");
        let u = hair.root_uv[i][0];
        if (u - 1.0).abs() > 0.2 {
            assert_eq!(width, [0.25, 0.5][tile]);
        }
    }
    assert!(seen[0] > 900 && seen[1] > 900, "{seen:?}");
}

#[test]
fn a_set_without_files_is_refused_with_pattern_and_folder() {
    let folder = Folder::with_square("roots.density = { map = 'maps/fur.<UDIM>.png' }");
    let words = folder.refusal();
    assert!(
        words.contains("roots.density: maps: No such file"),
        "{words}"
    );
    std::fs::create_dir(folder.path("maps")).unwrap();
    folder.write("maps/fur.png", "");
    assert_eq!(
        folder.refusal(),
        "error: groom.toml:1:17: roots.density: maps/fur.<UDIM>.png: no file in the folder maps \
         has such a name, with a number from 1001 to 9999 for <UDIM>; put the tiles there, or \
         correct the path\n  |\n\
         1 | roots.density = { map = 'maps/fur.<UDIM>.png' }\n  \
         |                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\n"
    );
    folder.write("maps/fur.1001.png", "not an image");
    let words = folder.refusal();
    assert!(words.contains("maps/fur.1001.png: not an image"), "{words}");
    folder.recipe("roots.density = { map = 'maps/fur.<UDIM>.png', wrap = 'mirror' }");
    let words = folder.refusal();
    assert!(
        words.contains("roots.density.wrap: says nothing beside"),
        "{words}"
    );
}

#[test]
fn where_a_set_has_no_tile_its_map_is_black_and_a_note_says_so() {
    let folder = Folder::with_square("roots.density = { map = 'fur.<UDIM>.png' }");
    folder.grey("fur.1002.png", &[255; 2]);
    // The first triangle's middle is in tile 1002, that of the second in 1001.
    assert_eq!(
        folder.notes(),
        "note: roots.density: fur.<UDIM>.png has no image for a triangle in tile 1001; \
         the map is black there\n"
    );
    let hair = folder.arrays("hair.npz", &[]);
    assert_eq!(hair.len(), 2000);
    assert!(hair.root_uv.iter().all(|uv| uv[0] > 0.5));
    folder.recipe("scale.amount = { map = 'fur.<UDIM>.png' }");
    let words = folder.notes();
    assert!(
        words.contains("scale.amount: ") && words.contains("have no length"),
        "{words}"
    );
    let negative = [0.0, 0.5, -1.0, 0.0];
    folder.exr("more.1002.exr", 1, &negative);
    folder.recipe("roots.density = { map = 'more.<UDIM>.exr' }");
    let words = folder.refusal();
    assert!(
        words.contains("roots.density: more.1002.exr: texel (column 0, row 1"),
        "{words}"
    );
}
