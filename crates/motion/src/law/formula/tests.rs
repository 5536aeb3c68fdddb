//! What formulas are worth, against an evaluation of their own; derivatives against differences; errors.
#![allow(clippy::unwrap_used, reason = "tests")]

use super::*;

fn formula(text: &str) -> Formula {
    Formula::new(text, &[]).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// What the formula gives, which is the negative of the force.
fn value(text: &str, x: f64, v: f64) -> f64 {
    -formula(text).force(x, v).value
}

fn error_of(text: &str) -> String {
    Formula::new(text, &[]).unwrap_err().to_string()
}

#[test]
fn operators_bind_as_in_mathematics() {
    let (x, v) = (3.0, 0.5);
    let cases = [
        ("x-1-v", x - 1.0 - v),
        ("x/2/4", x / 2.0 / 4.0),
        ("x - 2*v + 1", x - 2.0 * v + 1.0),
        ("-x^2", -9.0),
        ("(-x)^2", 9.0),
        ("2*-x^2", -18.0),
        ("x - -v", 3.5),
        ("-x*v", -1.5),
        ("x/-2", -1.5),
        ("+x", 3.0),
        ("2^(-x)", 0.125),
        ("(2^x)^2", 64.0),
        ("2^(x^2)", 512.0),
        ("2*x^2*v", 9.0),
        ("-(x + v)*-(x - v)", 8.75),
        ("x*1.5e-3 + .5 + 2.e1 + 1E2", 3.0 * 1.5e-3 + 120.5),
        ("sin(x)^2 + cos(x)^2", 1.0),
        ("x*pi", 3.0 * std::f64::consts::PI),
    ];
    for (text, expected) in cases {
        let found = value(text, x, v);
        assert!((found - expected).abs() <= 1e-15 * expected.abs(), "{text}: {found}, not {expected}");
    }
}

/// A spring, a damper: the formula is the force with which the element resists.
#[test]
fn the_force_on_the_structure_is_the_negative_of_the_formula() {
    let constants = [("c".to_owned(), -0.25), ("k".to_owned(), 2e3)];
    let law = Formula::new("k*x + c*v", &constants).unwrap();
    assert_eq!(law.force(0.5, 2.0), Force { value: -999.5, slope: -2e3, damping: 0.25 });
    // Nothing is nothing, without a sign.
    assert!(law.force(0.0, 0.0).value.is_sign_positive());
    assert!(law.depends_on_velocity() && !formula("x").depends_on_velocity());
}

/// Every function and operator, alone and within one another; differences of sixth order.
#[test]
fn derivatives_agree_with_differences() {
    let mut texts: Vec<String> = Function::ALL.map(|(name, _)| format!("{name}(0.3 + 0.2*x - 0.1*v)")).into();
    texts.extend(
        Function::ALL.map(|(name, _)| format!("x*{name}(0.5*cos(x*v)^2)/(2 + {name}(0.4*v^2 + 0.1))")),
    );
    let others =
        ["x^3*v^2", "x/v", "v^x + 2^x + v^1.5", "(x + v)^(-2)", "x^0 + x^1 + v", "-x^2*v - x/(v - 9)"];
    texts.extend(others.map(str::to_owned));
    for text in texts {
        // All are finite around here, but at rest.
        let law = shifted(&text);
        let at = |dx: f64, dv: f64| law.force(dx, dv).value;
        let step = 1e-2;
        let difference = |at: &dyn Fn(f64) -> f64| {
            let odd = |k: f64| at(k * step) - at(-k * step);
            (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * step)
        };
        let found = law.force(0.0, 0.0);
        for (found, expected) in
            [(found.slope, difference(&|dx| at(dx, 0.0))), (found.damping, difference(&|dv| at(0.0, dv)))]
        {
            // What is left of the differences: their seventh order, and rounding over the step.
            assert!((found - expected).abs() < 1e-9 * found.abs().max(1.0), "{text}: {found} {expected}");
        }
    }
}

/// The formula about `x = 0.7`, `v = 1.1`.
fn shifted(text: &str) -> Formula {
    // Names of functions have no `x` or `v` but `exp`.
    let moved = text.replace("exp", "EXP").replace('x', "(x+0.7)").replace('v', "(v+1.1)");
    formula(&moved.replace("EXP", "exp"))
}

/// The library that evaluates formulas counts what it has used up in words of 64 bits: sums and products of
/// up to four of these, against an evaluation of their own.
#[test]
fn long_formulas_are_worth_what_their_parts_are() {
    let mut random = 12345_u64;
    let mut next = |below: u64| {
        random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (random >> 33) % below
    };
    let parts = [("2", 2.0), ("3", 3.0), ("(x+1)", 1.9), ("cos(v)", 1.1_f64.cos())];
    for terms in [3, 20, 63, 64, 65, 100, 129, 140] {
        for _ in 0..20 {
            let (mut text, mut sum, mut product) = (String::new(), 0.0, 1.0);
            for k in 0..terms {
                let (name, worth) = parts[next(4) as usize];
                match next(4).min(k) {
                    0 | 1 if k == 0 => (text, product) = (name.to_owned(), worth),
                    0 => {
                        sum += product;
                        product = worth;
                        text = format!("{text}+{name}");
                    }
                    1 => {
                        sum += product;
                        product = -worth;
                        text = format!("{text}-{name}");
                    }
                    2 => {
                        product *= worth;
                        text = format!("{text}*{name}");
                    }
                    _ => {
                        product /= worth;
                        text = format!("{text}/{name}");
                    }
                }
            }
            sum += product;
            let text = format!("{text}+0*x");
            let found = value(&text, 0.9, 1.1);
            assert!((found - sum).abs() <= 1e-9 * sum.abs().max(1.0), "{text}: {found}, not {sum}");
        }
    }
}

#[test]
fn powers_are_finite_where_their_base_vanishes() {
    for (text, slope) in [("x^2", 0.0), ("x^1", 1.0), ("x^(3-1)", 0.0), ("x^1.5 + x", 1.0), ("x^0 + x", 1.0)]
    {
        assert_eq!(formula(text).force(0.0, 0.0).slope, 0.0 - slope, "{text}");
    }
    assert_eq!(
        formula("x*abs(v) + sqrt(x^2 + 1)").force(0.0, 0.0),
        Force { value: -1.0, slope: 0.0, damping: 0.0 }
    );
}

#[test]
fn corners_are_seen_by_the_form() {
    for text in ["x*abs(v)", "x*sqrt(x^2 + 1)", "x*(x*x)^1.75", "x^3 + 0.1*abs(x)^(2+1)"] {
        assert!(formula(text).has_corners(), "{text}");
    }
    for text in ["x", "x^3 - v^2*x", "tanh(20*v)", "x/(1 + v^2)", "exp(x) - 1", "sin(2.5*x)"] {
        assert!(!formula(text).has_corners(), "{text}");
    }
}

#[test]
fn oddness_is_seen_by_the_form() {
    let odd = [
        "x",
        "v",
        "-x",
        "x^3 + 2*x",
        "(x^2 - 1)*v",
        "sin(x)/cosh(v)",
        "x*abs(v)",
        "x^(2+1)",
        "tanh(2*v)",
        "x/(1+v^2)",
    ];
    let not = ["x + 1", "x^2", "x*v", "cos(x)", "x^3 + 0.001*x^2", "exp(x)", "abs(x)", "x + 1e-300*v^2"];
    assert!(odd.iter().all(|text| formula(text).is_odd()));
    for text in not {
        assert!(!formula(text).is_odd(), "{text}");
    }
    for text in odd {
        let law = formula(text);
        for (x, v) in [(0.3, -0.7), (12.0, 1e-3)] {
            assert_eq!(law.force(x, v).value, -law.force(-x, -v).value, "{text}");
        }
    }
}

/// Of `v^3` between a and b it is `a^2 + a b + b^2`, however near they are.
#[test]
fn mean_damping_keeps_its_digits() {
    let law = formula("v^3 + 1e6*x");
    for (a, b) in [(0.4, -0.3), (0.4, 0.4 - 1e-5), (0.4, 0.4 - 1e-12), (0.2, 0.2)] {
        let (found, exact) = (law.mean_damping(1.0, [a, b]), -(a * a + a * b + b * b));
        assert!((found / exact - 1.0).abs() < 1e-8, "{a} {b}: {found} {exact}");
    }
}

/// A force that turns between two plateaus, on which it has no slope: what counts is how far they are apart.
#[test]
fn mean_damping_sees_a_force_that_turns_quickly() {
    for text in ["tanh(v/0.001)", "1e9*x + tanh(v/0.001)"] {
        let found = formula(text).mean_damping(1.0, [1.0, -0.5]);
        assert!((found + 2.0 / 1.5).abs() < 1e-6, "{text}: {found}");
    }
}

#[test]
fn formulas_of_the_same_text_and_constants_are_the_same() {
    let with = |k: f64| Formula::new("k*x", &[("k".to_owned(), k)]).unwrap();
    assert!(with(2.0) == with(2.0) && with(2.0) != with(2.0 + f64::EPSILON * 2.0));
    assert_eq!(with(2.0), formula("2.0 * x"));
}

/// What is no formula is refused with the place and with what is wrong there.
#[test]
fn what_is_no_formula_is_refused_where_it_is() {
    let cases = [
        ("", "the formula is empty"),
        ("   ", "the formula is empty"),
        ("3*y + x", "`y` at character 3"),
        ("x + log(x)", "`log` at character 5"),
        ("(x + 1", "`(` at character 1 is not closed"),
        ("sin(x", "`(` at character 4 is not closed"),
        ("x + 1)", "`)` at character 6 closes nothing"),
        ("()", "before `)` at character 2"),
        ("x + ", "the formula ends where"),
        ("-", "the formula ends where"),
        ("x * / v", "before `/` at character 5"),
        ("x - - - v", "before `-` at character 7"),
        ("*x", "before `*` at character 1"),
        ("2x", "an operator is missing before `x` at character 2"),
        ("x 3", "an operator is missing before `3`"),
        ("x(v)", "an operator is missing before `(`"),
        ("1.2.3*x", "an operator is missing before `.3`"),
        ("sin x", "`sin` at character 1 is a function"),
        ("x + sin", "`sin` at character 5 is a function"),
        ("x^-2", "the sign of an exponent at character 3"),
        ("x^2^3", "at character 4, needs parentheses"),
        ("atan2(x, v)", "`,` at character 8 has no meaning"),
        ("max(x, v)", "`,` at character 6"),
        ("x ** 2", "before `*` at character 4"),
        ("{x}", "`{` at character 1"),
        ("µ*x", "`µ` at character 1"),
        ("x + 2µ", "`µ` at character 6"),
        ("x\t+ v", "at character 2 has no meaning"),
        ("x = 3", "`=` at character 3"),
        ("1e999*x", "the number `1e999` at character 1 is too large"),
        ("pi + 1", "neither `x` nor `v`"),
        ("1/x", "the force is inf at rest"),
        ("ln(x)", "the force is -inf at rest"),
        ("sqrt(x)", "the slope by `x` is inf at rest"),
        ("x + sqrt(v - 1)", "the force is NaN at rest"),
    ];
    for (text, expected) in cases {
        let found = error_of(text);
        // NaN has no sign, nor is it of interest which infinity.
        assert!(found.replace("-inf", "inf").contains(&expected.replace("-inf", "inf")), "{text}: {found}");
    }
}

#[test]
fn constants_have_names_of_their_own_finite_values_and_a_use() {
    let of =
        |name: &str, value: f64| Formula::new("k*x", &[(name.to_owned(), value)]).map_err(|e| e.to_string());
    assert!(of("k", -1.5e-300).is_ok());
    for (name, value, expected) in [
        ("x", 1.0, "`x` cannot be the name"),
        ("pi", 1.0, "it has a meaning already"),
        ("sin", 1.0, "it has a meaning already"),
        ("2k", 1.0, "names have letters"),
        ("", 1.0, "names have letters"),
        ("k k", 1.0, "names have letters"),
        ("µ", 1.0, "names have letters"),
        ("k", f64::NAN, "must be finite"),
        ("c", 1.0, "`k` at character 1 is not known"),
    ] {
        assert!(of(name, value).unwrap_err().contains(expected), "{name}");
    }
    let unused = [("k".to_owned(), 1.0), ("c".to_owned(), 1.0)];
    assert_eq!(Formula::new("k*x", &unused), Err(FormulaError::ConstantNotUsed { name: "c".into() }));
}

/// The library goes as deep as the parentheses and takes the square of the length.
#[test]
fn length_and_depth_are_bounded() {
    let deep = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    assert!(Formula::new(&deep(DEEPEST), &[]).is_ok());
    assert!(error_of(&deep(DEEPEST + 1)).contains("within one another at character 51"));
    assert!(error_of(&deep(10_000)).contains("the formula has 20001 characters, more than 1000"));
    assert!(error_of(&"(".repeat(900)).contains("within one another"));
    let long = format!("x{}", "+x".repeat(499));
    assert_eq!(value(&long, 1.0, 0.0), 500.0);
    assert!(error_of(&format!("{long}+x+x")).contains("more than 1000"));
    let functions = format!("{}x{}", "sin(".repeat(DEEPEST), ")".repeat(DEEPEST));
    assert!(Formula::new(&functions, &[]).is_ok());
    assert!(error_of(&"µ".repeat(1001)).contains("1001 characters, more than 1000"));
    assert!(error_of(&"µ".repeat(1000)).contains("`µ` at character 1"));
}

#[test]
fn motions_can_be_followed_on_other_threads() {
    fn is_shared<T: Send + Sync>() {}
    is_shared::<Formula>();
}
