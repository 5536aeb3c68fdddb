//! `hammerbeam signal lyapunov`: the largest exponent of a series.

use hammerbeam_results::export::{Table, header, number};
use hammerbeam_signal::{
    SignalError,
    exponent::{
        Divergence, DivergenceSettings, Embedding, EmbeddingChoice, ExponentEstimate, WolfExponent,
        WolfSettings, embedding, kantz, rosenstein, wolf,
    },
};
use serde_json::{Value, json};

use super::input::{self, Input, named};
use crate::{
    failure::Failure,
    output::Output,
    signal_args::{ExponentOptions, Method},
};

pub fn run(options: &ExponentOptions, output: Output) -> Result<(), Failure> {
    if options.method == Method::Wolf && options.fit.is_some() {
        let message =
            "--fit: Wolf's method has no curve and no straight part; take --method rosenstein, kantz or all";
        return Err(Failure::BadInput(message.to_owned()));
    }
    let input = input::open(&options.input, None)?;
    let whole = |number: Option<u32>| number.map(|number| number as usize);
    let choice = EmbeddingChoice {
        delay: whole(options.delay),
        dimension: whole(options.dimension),
        theiler_window: whole(options.theiler_window),
    };
    let (samples, rate) = (&input.channel().samples, input.record.sampling_rate_hz);
    let embedding = embedding(samples, &choice)?;
    let follow = DivergenceSettings { steps: whole(options.steps), fit: options.fit.unwrap_or_default() };
    let pair = WolfSettings { evolution: whole(options.evolution), ..WolfSettings::default() };
    let wanted = |method: Method| options.method == method || options.method == Method::All;
    let found = Found {
        wolf: wanted(Method::Wolf).then(|| wolf(samples, rate, &embedding, &pair)),
        rosenstein: wanted(Method::Rosenstein).then(|| rosenstein(samples, rate, &embedding, &follow)),
        kantz: wanted(Method::Kantz).then(|| kantz(samples, rate, &embedding, &follow)),
    };
    let found = found.checked()?;
    let path = write(&found, options, rate)?;
    let document = found.document(&input, &embedding, path.as_deref());
    output.give(&document, || found.text(&input, &embedding, path.as_deref()))?;
    Ok(())
}

type Tried<T> = Option<Result<T, SignalError>>;

/// What a method gave: the exponent, or why there is none.
struct Outcome {
    name: &'static str,
    exponent: Result<ExponentEstimate, String>,
}

struct Found {
    wolf: Tried<WolfExponent>,
    rosenstein: Tried<Divergence>,
    kantz: Tried<Divergence>,
}

impl Found {
    /// One method that finds nothing does not hide the others; if none finds anything, or the input is at
    /// fault, it is a failure.
    fn checked(self) -> Result<Self, Failure> {
        let given = |failed: Option<bool>| failed == Some(false);
        let any = given(self.wolf.as_ref().map(Result::is_err))
            || given(self.rosenstein.as_ref().map(Result::is_err))
            || given(self.kantz.as_ref().map(Result::is_err));
        let bad = |error: &&SignalError| error.is_bad_input();
        let errors = || {
            let wolf = self.wolf.as_ref().and_then(|tried| tried.as_ref().err());
            let others = [&self.rosenstein, &self.kantz]
                .map(|tried| tried.as_ref().and_then(|tried| tried.as_ref().err()));
            wolf.into_iter().chain(others.into_iter().flatten())
        };
        if let Some(error) = errors().find(bad) {
            return Err(Failure::BadInput(error.to_string()));
        }
        if !any {
            let reasons: Vec<String> = errors().map(SignalError::to_string).collect();
            return Err(Failure::NoResult(reasons.join("; ")));
        }
        Ok(self)
    }

    /// What each method that was tried gave.
    fn outcomes(&self) -> Vec<Outcome> {
        let outcome = |name, exponent: Result<ExponentEstimate, &SignalError>| Outcome {
            name,
            exponent: exponent.map_err(SignalError::to_string),
        };
        let divergence = |name, tried: &Tried<Divergence>| {
            tried.as_ref().map(|tried| outcome(name, tried.as_ref().map(|found| found.exponent)))
        };
        let wolf =
            self.wolf.as_ref().map(|tried| outcome("wolf", tried.as_ref().map(|found| found.exponent)));
        [wolf, divergence("rosenstein", &self.rosenstein), divergence("kantz", &self.kantz)]
            .into_iter()
            .flatten()
            .collect()
    }

    fn document(&self, input: &Input, embedding: &Embedding, path: Option<&str>) -> Value {
        let divergence = |tried: &Tried<Divergence>| {
            let found = tried.as_ref()?.as_ref().ok()?;
            Some(json!({
                "exponent_per_s": found.exponent.value,
                "scatter_per_s": found.exponent.scatter,
                "fit_samples": [found.fit.0, found.fit.1],
                "states": found.states,
                "radius": found.radius,
                "curve": found.curve,
            }))
        };
        let wolf = self.wolf.as_ref().and_then(|tried| tried.as_ref().ok()).map(|found| {
            json!({
                "exponent_per_s": found.exponent.value,
                "scatter_per_s": found.exponent.scatter,
                "evolution_samples": found.evolution,
                "stretches": found.evolutions,
                "kept": found.kept,
            })
        });
        let reason = |outcome: Outcome| Some((outcome.name.to_owned(), json!(outcome.exponent.err()?)));
        let reasons = self.outcomes().into_iter().filter_map(reason);
        let mut document = input.document();
        document["channel"] = json!(input.channel().name);
        document["delay_samples"] = json!(embedding.delay);
        document["dimension"] = json!(embedding.dimension);
        document["theiler_window_samples"] = json!(embedding.theiler_window);
        document["mean_period_samples"] = json!(embedding.mean_period);
        document["wolf"] = json!(wolf);
        document["rosenstein"] = json!(divergence(&self.rosenstein));
        document["kantz"] = json!(divergence(&self.kantz));
        document["no_result"] = Value::Object(reasons.collect());
        document["results"] = json!(path);
        document
    }

    fn text(&self, input: &Input, embedding: &Embedding, path: Option<&str>) -> String {
        let mut lines = vec![input.heading()];
        lines.push(format!(
            "{}: delay {} samples, dimension {}, Theiler window {} samples",
            named(input.channel()),
            embedding.delay,
            embedding.dimension,
            embedding.theiler_window
        ));
        for Outcome { name, exponent } in self.outcomes() {
            lines.push(match exponent {
                Ok(ExponentEstimate { value, scatter }) => {
                    format!(
                        "  {name:<10} {value:>12.5} 1/s  standard error of ten parts of the record \
                    {scatter:.5}"
                    )
                }
                Err(reason) => format!("  {name:<10} no result: {reason}"),
            });
        }
        for (name, tried) in [("rosenstein", &self.rosenstein), ("kantz", &self.kantz)] {
            if let Some(Ok(found)) = tried {
                lines.push(format!("  {name} fitted from sample {} to {}", found.fit.0, found.fit.1));
            }
        }
        lines.extend(path.map(|path| format!("{path}: mean logarithms of the distances")));
        lines.extend(input.notes());
        lines.join("\n")
    }
}

fn write(found: &Found, options: &ExponentOptions, rate: f64) -> Result<Option<String>, Failure> {
    let Some(folder) = &options.out else { return Ok(None) };
    let curve = |tried: &Tried<Divergence>| match tried {
        Some(Ok(found)) => found.curve.clone(),
        _ => Vec::new(),
    };
    let (nearest, within) = (curve(&found.rosenstein), curve(&found.kantz));
    let mut table = Table::begin(folder, "divergence.csv", &header(&["time_s", "rosenstein", "kantz"]))?;
    for k in 0..nearest.len().max(within.len()) {
        let entry = |curve: &[f64]| number(curve.get(k).copied());
        table.row(&[number(k as f64 / rate), entry(&nearest), entry(&within)])?;
    }
    Ok(Some(table.finish()?.display().to_string()))
}
