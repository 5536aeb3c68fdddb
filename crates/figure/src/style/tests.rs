use super::*;

/// Linear red, green and blue of a colour in sRGB (IEC 61966-2-1).
fn linear(colour: &str) -> [f64; 3] {
    [1, 3, 5].map(|at| {
        let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
        if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    })
}

fn times(matrix: &[[f64; 3]; 3], [a, b, c]: [f64; 3]) -> [f64; 3] {
    matrix.map(|[x, y, z]| x * a + y * b + z * c)
}

/// CIE L*, a*, b* of linear red, green and blue, white being that of sRGB (D65).
fn lab(linear: [f64; 3]) -> [f64; 3] {
    const TO_XYZ: [[f64; 3]; 3] = [
        [0.412_456_4, 0.357_576_1, 0.180_437_5],
        [0.212_672_9, 0.715_152_2, 0.072_175_0],
        [0.019_333_9, 0.119_192_0, 0.950_304_1],
    ];
    let (xyz, white) = (times(&TO_XYZ, linear), times(&TO_XYZ, [1.0; 3]));
    let [x, y, z] = std::array::from_fn(|k| {
        let share: f64 = xyz[k] / white[k];
        if share > 216.0 / 24389.0 { share.cbrt() } else { (24389.0 / 27.0 * share + 16.0) / 116.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// CIE lightness L* of a colour, 0 (black) to 100 (white).
fn lightness(colour: &str) -> f64 {
    lab(linear(colour))[0]
}

/// Colour vision: all three kinds of cones, or without those for long, medium or short waves. Machado,
/// Oliveira and Fernandes, IEEE Trans. Visualization and Computer Graphics 15 (2009), 1291-1298,
/// severity 1.
const EYES: [[[f64; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
];

/// Least distance of two colours in CIE L*a*b* (1976) to any eyes; about 2 is the least that can be seen
/// side by side.
fn distance(one: &str, other: &str) -> f64 {
    let seen =
        |eyes: &[[f64; 3]; 3], colour| lab(times(eyes, linear(colour)).map(|part: f64| part.clamp(0.0, 1.0)));
    let apart = EYES.iter().map(|eyes| {
        let [a, b] = [seen(eyes, one), seen(eyes, other)];
        (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
    });
    apart.fold(f64::INFINITY, f64::min)
}

fn pairs(count: u32) -> impl Iterator<Item = (u32, u32)> {
    (1..=count).flat_map(|one| (1..one).map(move |other| (other, one)))
}

#[test]
fn lightness_and_distance_are_those_of_the_standard() {
    for (colour, wanted) in [("#000000", 0.0), ("#ffffff", 100.0), ("#777777", 50.03)] {
        assert!((lightness(colour) - wanted).abs() < 0.02, "{colour}"); // as printed in tables of sRGB
    }
    assert!((distance("#000000", "#ffffff") - 100.0).abs() < 0.02);
    // Red and green of one lightness, which dichromats without red cones confuse.
    let (normal, confused) = (lab(linear("#c04040")), distance("#c04040", "#757520"));
    assert!(normal[1] > 40.0 && confused < 30.0);
}

/// In grey print a period is known by its lightness or by its strokes, to all eyes by its colour.
#[test]
fn every_two_of_nine_periods_are_told_apart_in_grey_print_and_by_all_eyes() {
    for (one, other) in pairs(9) {
        let [a, b] = [one, other].map(period_look);
        let apart = (lightness(a.colour) - lightness(b.colour)).abs();
        assert!(a.strokes != b.strokes || apart > 20.0, "{one} and {other}: {apart}");
        assert!(distance(a.colour, b.colour) > 20.0, "{one} and {other}");
    }
}

/// Contrast of two colours, 1 to 21 (WCAG 2.2, contrast ratio).
fn contrast(one: &str, other: &str) -> f64 {
    let [a, b] = [one, other].map(|colour| {
        let [red, green, blue] = linear(colour);
        0.2126 * red + 0.7152 * green + 0.0722 * blue + 0.05
    });
    (a / b).max(b / a)
}

/// Lines ask for 3:1 (WCAG 2.2, 1.4.11), on paper and on the page, light or dark.
#[test]
fn the_line_of_every_period_stands_out_from_the_paper() {
    assert!((contrast("#000000", "#ffffff") - 21.0).abs() < 1e-12); // the greatest there is
    assert!((contrast("#949494", "#ffffff") - 3.03).abs() < 0.005); // the palest grey of 3:1 on white
    for (number, dark) in [false, true].into_iter().enumerate() {
        let look = page_colours(dark);
        let paper = look["paper"].as_str().unwrap();
        let periods = look["periods"].as_array().unwrap();
        assert_eq!(periods.len(), 9);
        for colour in
            periods.iter().map(|colour| colour.as_str().unwrap()).chain([[PALE_INK, "#9a9a9a"][number]])
        {
            assert!(contrast(colour, paper) >= 3.0, "{colour} on {paper}: {}", contrast(colour, paper));
        }
    }
    assert!(overlaid_look(0).colour == PALE_INK && contrast(DOUBTFUL, PAPER) >= 3.0);
}

/// Numbered lines differ in their dashes, curves of bifurcations as well.
#[test]
fn no_two_numbered_lines_have_the_same_dashes() {
    let kinds = [Bifurcation::Fold, Bifurcation::Flip, Bifurcation::NeimarkSacker, Bifurcation::Grazing];
    for (one, other) in pairs(6) {
        let [a, b] = [one, other].map(|number| line_pattern(number as usize - 1));
        assert!(a.dashes != b.dashes && distance(a.colour, b.colour) > 20.0, "{one} and {other}");
    }
    for (one, other) in pairs(4) {
        let [a, b] = [one, other].map(|number| bifurcation_pattern(kinds[number as usize - 1]));
        assert!(a.dashes != b.dashes && distance(a.colour, b.colour) > 20.0, "{one} and {other}");
    }
}

/// Kinds of motion and areas differ in colour only: in its lightness.
#[test]
fn fills_are_told_apart_in_grey_print() {
    let kinds = MotionKind::ALL.map(kind_colour);
    let cells = [&FILLS[..], &[NOT_COMPUTED, IMPOSSIBLE]].concat();
    for colours in [&kinds[..], &cells[..]] {
        for (one, other) in pairs(colours.len() as u32) {
            let [a, b] = [one, other].map(|number| colours[number as usize - 1]);
            let apart = (lightness(a) - lightness(b)).abs();
            assert!(apart > 7.5 && distance(a, b) > 10.0, "{a} and {b}: {apart}, {}", distance(a, b));
        }
    }
}

#[test]
fn every_colour_of_a_period_stands_out_on_a_dark_page() {
    for colour in PERIOD_COLOURS_DARK {
        assert!(lightness(colour) > 65.0, "{colour} is too dark for a thin line");
    }
    for (one, other) in pairs(9) {
        let [a, b] = [one, other].map(|number| PERIOD_COLOURS_DARK[number as usize - 1]);
        assert!(distance(a, b) > 15.0, "{a} and {b}");
    }
}

#[test]
fn every_period_has_a_look() {
    assert_eq!(period_look(0), period_look(1));
    assert_eq!(period_look(10), period_look(1));
    assert_ne!(period_look(2), period_look(3));
}
