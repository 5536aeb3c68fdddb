//! Reading a force law that is given as a formula.

use hammerbeam_motion::law::{
    CONSTANTS, DEEPEST, Formula, FormulaError, Function, LONGEST, LawValue, VARIABLES,
};

use crate::document::{TomlTable, closest, quantity};

/// `formula`, and `constants` with a number for each name.
pub(super) fn read(table: &TomlTable<'_>) -> Option<LawValue> {
    let formula = table.required("formula");
    let constants = table
        .optional("constants")
        .map_or(Some(Vec::new()), |value| value.table()?.named_numbers(&quantity::ANY));
    let (formula, constants) = (formula?, constants?);
    let text = formula.text()?;
    if let Err(error) = Formula::new(text, &constants) {
        formula.problem(format!("`formula`: {error}"), help(&error, &constants));
        return None;
    }
    Some(LawValue::Formula(text.to_owned(), constants))
}

/// What a formula may have where an error is.
fn help(error: &FormulaError, constants: &[(String, f64)]) -> Vec<String> {
    let functions = || Function::ALL.iter().map(|(name, _)| *name);
    let values = || {
        let known = VARIABLES.into_iter().chain(CONSTANTS.iter().map(|(name, _)| *name));
        known.chain(constants.iter().map(|(name, _)| name.as_str()))
    };
    let listed = |names: &[&str]| names.join(", ");
    match error {
        FormulaError::UnknownName { name, .. } => {
            let close = closest(name, values().chain(functions()));
            let mut help: Vec<String> =
                close.map(|close| format!("did you mean `{close}`?")).into_iter().collect();
            help.push(format!(
                "allowed: {}, names in `constants`, and the functions {}",
                listed(&values().collect::<Vec<_>>()),
                listed(&functions().collect::<Vec<_>>())
            ));
            help
        }
        FormulaError::TooLong { .. } | FormulaError::TooDeep { .. } => {
            let depth = format!("{DEEPEST} parentheses within one another");
            vec![format!("allowed: at most {LONGEST} characters and {depth}")]
        }
        FormulaError::ConstantName { .. } => {
            let constants = CONSTANTS.iter().map(|(name, _)| *name);
            let taken: Vec<&str> = VARIABLES.into_iter().chain(constants).chain(functions()).collect();
            vec![format!("taken: {}", listed(&taken))]
        }
        FormulaError::NotFiniteAtRest { .. } => {
            vec!["allowed: a force that is finite at rest, and so are its derivatives".into()]
        }
        _ => {
            let example = "as in \"c*(x^2 - 1)*v\"";
            vec![format!("allowed: numbers, names, `+ - * / ^`, parentheses and functions, {example}")]
        }
    }
}
