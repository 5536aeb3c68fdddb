//! What a file declares: modules, imports, items, and the types that its `impl` blocks add to.

use super::tokens::{Token, tokens};

/// A path that an import names, and the name that it gives it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Import {
    pub path: Vec<String>,
    /// `None` for all that is there.
    pub name: Option<String>,
    /// Whether others may import it from here.
    pub is_public: bool,
}

/// What one file says, tests left out.
#[derive(Debug, Default)]
pub struct Items {
    /// Modules with files of their own.
    pub modules: Vec<String>,
    pub imports: Vec<Import>,
    /// Names of types, traits, functions, constants, with whether it is a type, and whether it is public.
    pub declared: Vec<Declared>,
    /// Names of the types of `impl` blocks.
    pub implemented: Vec<Vec<String>>,
    /// Paths in the code, `a::b`, and single names.
    pub mentioned: Vec<Vec<String>>,
}

/// A name that a file declares outside of `impl` blocks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Declared {
    pub name: String,
    /// A struct, an enum, a union, a trait or an alias.
    pub is_type: bool,
    /// `pub` without a bound.
    pub is_public: bool,
}

const TYPES: [&str; 5] = ["struct", "enum", "union", "trait", "type"];
const OTHERS: [&str; 3] = ["fn", "const", "static"];

impl Items {
    pub fn read(source: &str) -> Self {
        let all = tokens(source);
        let mut items = Self::default();
        let mut at = 0;
        // Depth of braces, and that at which an `impl` or a function began: what it declares is its own.
        let (mut depth, mut inside) = (0, None);
        while at < all.len() {
            let visibility = visibility(&all, at);
            let word = all[at].word().unwrap_or("");
            if word == "use" {
                let (imports, length) = use_trees(&all[at + 1..], visibility != Visibility::Private);
                items.imports.extend(imports);
                at += 1 + length;
                continue;
            }
            match &all[at] {
                Token::Sign('{') => depth += 1,
                Token::Sign('}') => {
                    depth -= 1;
                    inside = inside.filter(|outer| *outer < depth);
                }
                Token::Word(_) if inside.is_none() => {
                    items.declare(&all[at..], visibility);
                    if word == "impl" && starts_item(&all, at) {
                        items.implemented.extend(implemented_type(&all[at + 1..]));
                    }
                    if word == "fn" || word == "trait" || word == "impl" && starts_item(&all, at) {
                        inside = Some(depth);
                    }
                }
                Token::Sign(';') if inside == Some(depth) => inside = None,
                _ => {}
            }
            let mention = mention(&all[at..]);
            let follows_path = at > 0 && (all[at - 1] == Token::Path || all[at - 1].is("."));
            if !mention.is_empty() && !follows_path {
                items.mentioned.push(mention);
            }
            at += 1;
        }
        items
    }

    fn declare(&mut self, rest: &[Token], visibility: Visibility) {
        let [Token::Word(keyword), Token::Word(name), ..] = rest else { return };
        if keyword == "mod" && rest.get(2).is_some_and(|token| token.is(";")) {
            self.modules.push(name.clone());
        }
        let is_type = TYPES.contains(&keyword.as_str());
        let is_name = name != "fn";
        if is_type || is_name && OTHERS.contains(&keyword.as_str()) {
            let is_public = visibility == Visibility::Public;
            self.declared.push(Declared { name: name.clone(), is_type, is_public });
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Visibility {
    Private,
    Bounded,
    Public,
}

/// How far the item can be seen whose keyword stands here.
fn visibility(all: &[Token], at: usize) -> Visibility {
    let before = |back: usize| at.checked_sub(back).map(|place| &all[place]);
    match before(1) {
        Some(token) if token.is("pub") => Visibility::Public,
        Some(token) if token.is(")") => {
            let opens = (1..at.min(8)).find(|back| all[at - back].is("("));
            let is_bound = opens.and_then(|back| before(back + 1)).is_some_and(|token| token.is("pub"));
            if is_bound { Visibility::Bounded } else { Visibility::Private }
        }
        Some(token) if ["const", "unsafe", "async"].iter().any(|word| token.is(word)) => {
            visibility(all, at - 1)
        }
        _ => Visibility::Private,
    }
}

/// Whether `impl` here opens a block, and does not say what a function takes or gives.
fn starts_item(all: &[Token], at: usize) -> bool {
    at == 0 || [";", "}", "]", "{", "unsafe"].iter().any(|sign| all[at - 1].is(sign))
}

/// The path of the type that an `impl` block is for; none for slices, tuples and the like.
fn implemented_type(rest: &[Token]) -> Option<Vec<String>> {
    let head = rest.iter().position(|token| token.is("{")).map_or(rest, |end| &rest[..end]);
    let head = head.iter().position(|token| token.is("where")).map_or(head, |end| &head[..end]);
    let head = &head[generics(head)..];
    let mut depth = 0;
    let mut start = 0;
    for (at, token) in head.iter().enumerate() {
        match token {
            Token::Sign('<') => depth += 1,
            Token::Sign('>') if !head[at - 1].is("-") => depth -= 1,
            token if depth == 0 && token.is("for") => start = at + 1,
            _ => {}
        }
    }
    let path = mention(
        head[start..].iter().skip_while(|token| token.is("&")).cloned().collect::<Vec<_>>().as_slice(),
    );
    (!path.is_empty() && path[0] != "dyn").then_some(path)
}

/// Length of the parameters `<…>` at the start, zero if there are none.
fn generics(head: &[Token]) -> usize {
    if !head.first().is_some_and(|token| token.is("<")) {
        return 0;
    }
    let mut depth = 0;
    for (at, token) in head.iter().enumerate() {
        match token {
            Token::Sign('<') => depth += 1,
            Token::Sign('>') if !head[at - 1].is("-") => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at + 1;
        }
    }
    head.len()
}

/// The path `a::b::c` that starts here.
fn mention(rest: &[Token]) -> Vec<String> {
    let mut path = Vec::new();
    let mut at = 0;
    while let Some(Token::Word(word)) = rest.get(at) {
        path.push(word.clone());
        if rest.get(at + 1) != Some(&Token::Path) {
            break;
        }
        at += 2;
    }
    path
}

/// All imports of the tree behind `use`, and how many tokens it has, the semicolon included.
fn use_trees(rest: &[Token], is_public: bool) -> (Vec<Import>, usize) {
    let length = rest.iter().position(|token| token.is(";")).map_or(rest.len(), |end| end + 1);
    let mut imports = Vec::new();
    let mut at = 0;
    use_tree(&rest[..length], &mut at, &[], &mut |path: Vec<String>, name| {
        imports.push(Import { path, name, is_public });
    });
    (imports, length)
}

fn use_tree(
    tree: &[Token],
    at: &mut usize,
    prefix: &[String],
    found: &mut dyn FnMut(Vec<String>, Option<String>),
) {
    let mut path = prefix.to_vec();
    loop {
        match tree.get(*at) {
            Some(Token::Word(word)) if word != "as" => path.push(word.clone()),
            Some(Token::Path) => {}
            Some(Token::Sign('*')) => {
                *at += 1;
                return found(path, None);
            }
            Some(Token::Sign('{')) => {
                *at += 1;
                while !tree[*at].is("}") {
                    use_tree(tree, at, &path, found);
                    if tree[*at].is(",") {
                        *at += 1;
                    }
                }
                *at += 1;
                return;
            }
            Some(Token::Word(_)) => {
                let name = tree[*at + 1].word().map(str::to_owned);
                *at += 2;
                return found(path, name);
            }
            _ => {
                if path.last().is_some_and(|last| last == "self") && path.len() > 1 {
                    path.pop();
                }
                let name = path.last().cloned();
                return found(path, name);
            }
        }
        *at += 1;
    }
}

#[test]
fn imports_are_read_with_their_trees_and_names() {
    let items = Items::read("pub(crate) use a::{b, c::{self, D as E}, f::*}; use super::G;");
    let show = |import: &Import| {
        format!("{} {} {}", import.path.join("."), import.name.as_deref().unwrap_or("*"), import.is_public)
    };
    let shown: Vec<String> = items.imports.iter().map(show).collect();
    assert_eq!(shown, ["a.b b true", "a.c c true", "a.c.D E true", "a.f * true", "super.G G false"]);
}

#[test]
fn impl_blocks_name_their_types() {
    let items = Items::read(
        "impl<'a, F: Fn(&A) -> B> Trait<C> for d::E<'a, F> where F: G { fn f(x: impl H) -> impl I { J::k() } }
         pub struct L; impl L { pub fn new() -> Self { Self } } fn m() { struct N; }
         pub(crate) enum O {} pub const fn p() {} impl dyn Q {} impl<T> R for [T] {}",
    );
    assert_eq!(items.implemented, [vec!["d".to_owned(), "E".to_owned()], vec!["L".to_owned()]]);
    let shown: Vec<String> =
        items.declared.iter().map(|d| format!("{} {} {}", d.name, d.is_type, d.is_public)).collect();
    assert_eq!(shown, ["L true true", "m false false", "O true false", "p false true"]);
}
