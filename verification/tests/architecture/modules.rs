//! The modules of a crate, each with its file, and what they import from one another.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    items::{Import, Items},
    read, root,
};

/// A module with a file of its own, by its path from the root of the crate, which is the empty path.
type ModulePath = Vec<String>;

/// One crate as its files say it.
pub struct Modules {
    /// File and contents of each module.
    files: BTreeMap<ModulePath, (String, Items)>,
}

/// How many imports of imports are followed.
const DEEPEST: u32 = 12;

impl Modules {
    /// Reads the crate in this folder, from its library or its program.
    pub fn read(folder: &str) -> Self {
        let first = ["lib.rs", "main.rs"].map(|name| format!("{folder}/src/{name}"));
        let first = first.iter().find(|path| root().join(path).exists()).unwrap_or(&first[0]);
        let mut modules = Self { files: BTreeMap::new() };
        modules.add(Vec::new(), first.clone(), &format!("{folder}/src"));
        modules
    }

    /// * `folder`: where the files of its own modules lie.
    fn add(&mut self, module: ModulePath, file: String, folder: &str) {
        let items = Items::read(&read(&file));
        for name in &items.modules {
            let below = format!("{folder}/{name}");
            let files = [format!("{below}.rs"), format!("{below}/mod.rs")];
            let found = files.iter().find(|path| root().join(path).exists());
            let found = found.unwrap_or_else(|| panic!("no file for module {name} of {file}"));
            let path = module.iter().chain([name]).cloned().collect();
            self.add(path, found.clone(), &below);
        }
        self.files.insert(module, (file, items));
    }

    /// Files with what they say.
    pub fn files(&self) -> impl Iterator<Item = &(String, Items)> {
        self.files.values()
    }

    /// For each file those that it needs: where the names come from that it imports or writes with a path.
    ///
    /// What a module only passes on (`pub use`, not used itself) it does not need.
    pub fn needs(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let need = |(module, (file, items)): (&ModulePath, &'_ (String, Items))| {
            let imported = items.imports.iter().filter(|import| is_used(items, import));
            let imported =
                imported.filter_map(|import| self.declaring(module, &import.path, import.name.is_none()));
            let written = items.mentioned.iter().filter(|path| path.len() > 1);
            let written = written.filter_map(|path| self.declaring(module, path, false));
            let others = imported.chain(written).filter(|other| *other != module);
            (
                module.clone(),
                file.clone(),
                others.map(|other| self.files[other].0.clone()).collect::<Vec<_>>(),
            )
        };
        let all: Vec<_> = self.files.iter().map(need).collect();
        let name = |file: &str| {
            let found = self.files.values().find(|(other, _)| other == file);
            found.map(|(file, _)| file.as_str()).expect("a file of this crate")
        };
        all.iter()
            .map(|(_, file, others)| (name(file), others.iter().map(|other| name(other)).collect()))
            .collect()
    }

    /// The file in which the type of an `impl` block is declared, if this crate declares it.
    pub fn declares(&self, file: &str, path: &[String]) -> Option<&str> {
        let (module, (_, items)) = self.files.iter().find(|(_, (other, _))| other == file)?;
        let here = path.len() == 1 && items.declared.iter().any(|declared| declared.name == path[0]);
        let declaring = if here { module } else { self.declaring(module, path, false)? };
        let (file, items) = &self.files[declaring];
        let name = path.last()?;
        items
            .declared
            .iter()
            .any(|declared| declared.is_type && declared.name == *name)
            .then_some(file.as_str())
    }

    /// The module that declares what a path means that is written in a module; `None` if that is another
    /// crate, or a module itself.
    ///
    /// * `is_all`: all that is in there is meant, so that a module is an answer.
    fn declaring(&self, module: &ModulePath, path: &[String], is_all: bool) -> Option<&ModulePath> {
        match self.resolve(module, path, DEEPEST)? {
            Meaning::Module(found) => is_all.then_some(found),
            Meaning::Item(found) => Some(found),
        }
    }

    fn resolve(&self, module: &ModulePath, path: &[String], deepest: u32) -> Option<Meaning<'_>> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => self.walk(&Vec::new(), rest, deepest),
            "self" => self.walk(module, rest, deepest),
            "super" => self.walk(&module[..module.len().checked_sub(1)?].to_vec(), rest, deepest),
            "Self" => None,
            _ => self.look_up(module, path, deepest),
        }
    }

    /// Follows a path from a module that is known.
    fn walk(&self, module: &ModulePath, path: &[String], deepest: u32) -> Option<Meaning<'_>> {
        match path.first().map(String::as_str) {
            None => self.files.get_key_value(module).map(|(found, _)| Meaning::Module(found)),
            Some("super") => self.walk(&module[..module.len().checked_sub(1)?].to_vec(), &path[1..], deepest),
            Some("self") => self.walk(module, &path[1..], deepest),
            // What is not found is declared by a macro, or in a module without a file.
            Some(_) => self
                .look_up(module, path, deepest)
                .or_else(|| self.files.get_key_value(module).map(|(found, _)| Meaning::Item(found))),
        }
    }

    /// What the first name of a path is in a module: one of its modules, its own, or imported.
    fn look_up(&self, module: &ModulePath, path: &[String], deepest: u32) -> Option<Meaning<'_>> {
        let deepest = deepest.checked_sub(1)?;
        let (first, rest) = path.split_first()?;
        let (found, (_, items)) = self.files.get_key_value(module)?;
        let below: ModulePath = module.iter().chain([first]).cloned().collect();
        if self.files.contains_key(&below) {
            return self.walk(&below, rest, deepest);
        }
        if items.declared.iter().any(|declared| declared.name == *first) {
            return Some(Meaning::Item(found));
        }
        // `use faer::Mat` in a module that is asked for `faer`: another crate.
        let named = items
            .imports
            .iter()
            .find(|import| import.name.as_ref() == Some(first) && import.path.first() != Some(first));
        if let Some(import) = named {
            return match self.resolve(module, &import.path, deepest)? {
                Meaning::Module(inner) => self.walk(&inner.clone(), rest, deepest),
                item => Some(item),
            };
        }
        items.imports.iter().filter(|import| import.name.is_none()).find_map(|import| {
            let Meaning::Module(inner) = self.resolve(module, &import.path, deepest)? else { return None };
            if inner == module { None } else { self.look_up(&inner.clone(), path, deepest) }
        })
    }
}

enum Meaning<'a> {
    Module(&'a ModulePath),
    /// Something that this module declares.
    Item(&'a ModulePath),
}

/// Whether the module itself needs what it imports.
fn is_used(items: &Items, import: &Import) -> bool {
    let Some(name) = &import.name else { return !import.is_public };
    !import.is_public || items.mentioned.iter().any(|path| path.first() == Some(name))
}
