//! `hammerbeam rig`: a measurement made with another model, and the whole comparison of it with the branches
//! of a study.

mod report;
mod signals;

use hammerbeam_drawing::{DrawSettings, draw_compared, draw_into};
use hammerbeam_jobs::{
    PreparedStudy,
    pool::threads,
    rig::{measure_rig, write_rig_tables},
};
use serde_json::json;

use crate::{
    compare_args::RigOptions, failure::Failure, interrupt::Interrupt, output::Output, progress::Terminal,
    watch::Watch,
};

pub fn run(options: &RigOptions, output: Output) -> Result<(), Failure> {
    let file = options.study.read()?;
    file.forced()?;
    let study = PreparedStudy::new(file)?;
    let interrupt = Interrupt::listen(output)?;
    let threads = threads(options.jobs);
    let (mut terminal, mut watch) = (Terminal::new(interrupt.clone(), 0), Watch::new(interrupt));
    let found = measure_rig(&study, &options.out, threads, (&mut terminal, &mut watch));
    terminal.clear();
    let found = found?;
    let settings = DrawSettings { threads, frequency_unit: output.frequency_unit, ..DrawSettings::default() };
    let mut document = serde_json::to_value(&found).expect("results are plain data with text keys");
    let drawn = draw_into::<Failure>(&options.out, settings, &mut watch, |drawn| {
        write_rig_tables(&options.out, &found, &mut drawn.files)?;
        for (name, compared) in found.compared() {
            draw_compared(&found.file, &compared, name, drawn);
        }
        report::write(&options.out, &found, &document, &mut drawn.files)
    });
    let files = drawn?.names;
    document["folder"] = json!(options.out);
    document["files"] = json!(files);
    output.give(&document, || report::text(&found, &options.out, &files))?;
    Ok(())
}
