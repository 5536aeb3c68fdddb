//! `hammerbeam run --vary-set`: a family of studies, one run after the other, each in a folder of its own.

use std::path::PathBuf;

use hammerbeam_jobs::{PreparedStudy, counted};
use hammerbeam_results::whole_file::subfolder;
use hammerbeam_study::{Setting, StudyFile};
use serde_json::{Map, Value, json};

use super::summary::{Summary, run_into};
use crate::{
    args::RunOptions,
    failure::Failure,
    interrupt::Interrupt,
    output::{Output, notify},
};

/// A study of the family.
struct Member {
    settings: Vec<Setting>,
    folder: PathBuf,
    study: PreparedStudy,
}

/// Runs all of them. What is wrong with one of the studies is found before the first runs.
pub fn run(options: &RunOptions, output: Output) -> Result<(), Failure> {
    let members = members(options)?;
    let interrupt = Interrupt::listen(output)?;
    let (mut documents, mut texts, mut failed) = (Vec::new(), Vec::new(), Vec::new());
    for member in &members {
        match run_into(&member.folder, &member.study, options, (output, &interrupt)) {
            Ok(summary) => {
                documents.push(member.document(&summary));
                texts.push(format!("{}\n{}", member.name(), summary.text()));
            }
            Err(Failure::NoResult(message)) => failed.push(format!("{}: {message}", member.name())),
            Err(other) => return Err(other.and(&format!("{} done", counted(documents.len() as u64, "run")))),
        }
    }
    if documents.is_empty() {
        return Err(Failure::NoResult(failed.join("\n")));
    }
    for message in &failed {
        notify(&format!("no result: {message}"));
    }
    output.give(&json!({ "runs": documents, "failed": failed }), || texts.join("\n\n"))
}

fn members(options: &RunOptions) -> Result<Vec<Member>, Failure> {
    let mut members: Vec<Member> = Vec::new();
    for settings in Setting::combinations(&options.vary_set) {
        let folder = subfolder(&options.out, &Setting::folder_name(&settings))?;
        if let Some(same) = members.iter().find(|member| member.folder == folder) {
            let message = format!("two studies of the family would be run into {}", same.folder.display());
            return Err(Failure::BadInput(message));
        }
        let all = [options.study.set.clone(), settings.clone()].concat();
        let file = StudyFile::read_with(&options.study.path, &all)?;
        file.forced()?;
        members.push(Member { settings, folder, study: PreparedStudy::new(file)? });
    }
    Ok(members)
}

impl Member {
    fn name(&self) -> String {
        let names: Vec<String> =
            self.settings.iter().map(|one| format!("{} = {}", one.key, one.value)).collect();
        names.join(", ")
    }

    fn document(&self, summary: &Summary) -> Value {
        let set: Map<String, Value> =
            self.settings.iter().map(|one| (one.key.clone(), json!(one.value))).collect();
        json!({ "set": set, "run": summary.report })
    }
}
