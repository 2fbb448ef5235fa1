//! What one module imports, declares and uses, once its conditions are decided.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

use super::Features;
use super::conditional::{self, blanked};
use super::depth;
use super::error::{ErrorKind, ShaderError, Source};
use super::parameter::{self, Parameter};
use super::probe::{self, Call};
use super::token::{Token, TokenKind};

/// A name at a place of the module.
#[derive(Clone, Debug)]
pub struct Named {
    pub name: String,
    pub range: Range<usize>,
}

/// One name taken from another module.
#[derive(Clone, Debug)]
pub struct Import {
    /// `lib/rng`, or `gen`.
    pub module: String,
    pub item: Named,
}

/// A module under a set of features.
pub struct Module {
    pub source: Arc<Source>,
    /// WGSL without imports and directives, byte by byte where the source has it.
    pub text: String,
    pub imports: Vec<Import>,
    /// `enable` and its like, which stand before everything else in a linked text.
    pub directives: Vec<Range<usize>>,
    /// What it declares at its top level.
    pub declarations: Vec<Named>,
    /// Those of them that are set while it runs.
    pub parameters: Vec<Parameter>,
    /// The numbers that its code shows of itself.
    pub probes: Vec<Call>,
    /// Names declared inside functions and structs.
    pub locals: BTreeSet<String>,
    /// Names that may mean a declaration of any module.
    pub uses: Vec<Named>,
    /// The features that its conditions name.
    pub features: Features,
}

impl Module {
    /// Whether a name of another's declaration, or of a parameter, means that here.
    pub fn knows(&self, name: &str) -> bool {
        let declared = self.parameters.iter().any(|own| own.name == name);
        declared || self.imports.iter().any(|import| import.item.name == name)
    }
}

/// Reads a module under a set of features.
pub fn scan(source: &Arc<Source>, features: &Features) -> Result<Module, ShaderError> {
    let resolved = conditional::resolve(source, features)?;
    depth::check_tokens(source, &resolved.tokens)?;
    let mut scanner = Scanner {
        source,
        tokens: &resolved.tokens,
        heard: probe::is_heard(features),
        open: Vec::new(),
        blank: Vec::new(),
        module: Module {
            source: source.clone(),
            text: String::new(),
            imports: Vec::new(),
            directives: Vec::new(),
            declarations: Vec::new(),
            parameters: Vec::new(),
            probes: Vec::new(),
            locals: BTreeSet::new(),
            uses: Vec::new(),
            features: resolved.named,
        },
    };
    scanner.scan()?;
    let Scanner { blank, mut module, .. } = scanner;
    module.text = blanked(&resolved.text, &blank);
    Ok(module)
}

struct Scanner<'a> {
    source: &'a Arc<Source>,
    tokens: &'a [Token],
    /// Somebody listens to probes.
    heard: bool,
    /// The brackets that are open.
    open: Vec<&'a str>,
    blank: Vec<Range<usize>>,
    module: Module,
}

impl<'a> Scanner<'a> {
    fn text(&self, i: usize) -> &'a str {
        self.tokens.get(i).map_or("", |token| &self.source.text[token.range.clone()])
    }

    fn is_word(&self, i: usize) -> bool {
        self.tokens.get(i).is_some_and(|token| token.kind == TokenKind::Word)
    }

    fn range(&self, i: usize) -> Range<usize> {
        let end = self.source.text.len();
        self.tokens.get(i).map_or(end..end, |token| token.range.clone())
    }

    fn named(&self, i: usize) -> Named {
        Named { name: self.text(i).to_owned(), range: self.range(i) }
    }

    fn error(&self, kind: ErrorKind, i: usize, message: impl Into<String>) -> ShaderError {
        ShaderError::at(kind, self.source, self.range(i), message)
    }

    fn scan(&mut self) -> Result<(), ShaderError> {
        let mut i = 0;
        while i < self.tokens.len() {
            let (text, depth) = (self.text(i), self.open.len());
            let starts_item = i == 0 || matches!(self.text(i - 1), ";" | "}");
            match text {
                "{" | "(" | "[" => self.open.push(text),
                "}" | ")" | "]" => {
                    self.open.pop();
                }
                "import" if depth == 0 => {
                    i = self.import(i)?;
                    continue;
                }
                "enable" | "requires" | "diagnostic" if depth == 0 && starts_item => {
                    i = self.directive(i);
                    continue;
                }
                "@" | "override" if depth == 0 && parameter::starts(self.source, self.tokens, i) => {
                    i = self.parameter(i)?;
                    continue;
                }
                // An attribute's own name, and the name of a built-in value, mean no declaration.
                "@" => {
                    i += if self.text(i + 1) == "builtin" { 5 } else { 2 };
                    continue;
                }
                _ if probe::starts(self.source, self.tokens, i) => {
                    i = self.probe(i)?;
                    continue;
                }
                _ if self.is_word(i) => self.word(i, depth)?,
                _ => {}
            }
            i += 1;
        }
        match self.tokens.len().checked_sub(1) {
            // In a joined text the error would show up in the next module.
            Some(last) if !matches!(self.text(last), ";" | "}") => {
                Err(self.error(ErrorKind::Syntax, last, "the module ends here, in the middle of a declaration"))
            }
            _ => Ok(()),
        }
    }

    /// Files a word as declaration, local or use.
    fn word(&mut self, i: usize, depth: usize) -> Result<(), ShaderError> {
        match self.text(i) {
            "fn" | "struct" | "const" | "alias" | "let" | "var" => {
                let name = if self.text(i) == "var" { self.behind_template(i + 1) } else { i + 1 };
                if !self.is_word(name) {
                    return Ok(());
                }
                probe::check_declared(self.source, self.text(i), &self.range(name))?;
                if depth == 0 {
                    self.module.declarations.push(self.named(name));
                } else {
                    self.module.locals.insert(self.text(name).to_owned());
                }
            }
            _ if self.text(i + 1) == ":" => {
                if depth > 0 {
                    self.module.locals.insert(self.text(i).to_owned());
                }
            }
            _ if i > 0 && self.text(i - 1) == "." => {}
            _ => self.module.uses.push(self.named(i)),
        }
        Ok(())
    }

    /// `probe("mis weight", weight);`: returns the token to go on from, which is the value's first where somebody listens.
    fn probe(&mut self, start: usize) -> Result<usize, ShaderError> {
        let in_block = self.open.last() == Some(&"{");
        let probe::Read { call, value, end } = probe::read(self.source, self.tokens, start, in_block)?;
        let next = if self.heard {
            // The call's own, which the value is in.
            self.open.push("(");
            value
        } else {
            self.blank.push(call.statement.clone());
            end
        };
        self.module.probes.push(call);
        Ok(next)
    }

    /// The token behind the `<storage, read>` that may stand at a token.
    fn behind_template(&self, i: usize) -> usize {
        if self.text(i) != "<" {
            return i;
        }
        (i..self.tokens.len()).find(|&i| self.text(i) == ">").map_or(self.tokens.len(), |close| close + 1)
    }

    /// `@range(0.0, 16.0) override NAME: f32 = 8.0;`
    fn parameter(&mut self, start: usize) -> Result<usize, ShaderError> {
        if start > 0 && !matches!(self.text(start - 1), ";" | "}") {
            let error = self.error(ErrorKind::Parameter, start, "a parameter has no attribute but `@range`");
            return Err(error.help(parameter::EXAMPLE));
        }
        let (parameter, end) = parameter::read(self.source, self.tokens, start)?;
        if self.text(end - 1) != ";" {
            return Err(self.error(ErrorKind::Syntax, end - 1, format!("`{}` wants a `;` behind it", parameter.name)));
        }
        let range = parameter.place.range.clone();
        self.module.declarations.push(Named { name: parameter.name.clone(), range });
        self.module.parameters.push(parameter);
        self.blank.push(self.range(start).start..self.range(end - 1).end);
        Ok(end)
    }

    fn directive(&mut self, start: usize) -> usize {
        let end = (start..self.tokens.len()).find(|&i| self.text(i) == ";").unwrap_or(self.tokens.len() - 1);
        let range = self.range(start).start..self.range(end).end;
        self.blank.push(range.clone());
        self.module.directives.push(range);
        end + 1
    }

    /// `import package::lib::rng::{next_2d, next_1d};`
    fn import(&mut self, start: usize) -> Result<usize, ShaderError> {
        if self.text(start + 1) != "package" {
            let message = "an import starts with `package::`, the folder shaders/";
            return Err(self.error(ErrorKind::Syntax, start + 1, message));
        }
        let end = self.import_path(start + 2, &mut Vec::new())?;
        if self.text(end) != ";" {
            return Err(self.error(
                ErrorKind::Syntax,
                end,
                "an import ends with `;`; renaming with `as` is not supported",
            ));
        }
        self.blank.push(self.range(start).start..self.range(end).end);
        Ok(end + 1)
    }

    /// Reads `::name` and `::{..}` behind a path, and returns the token behind them.
    fn import_path(&mut self, start: usize, path: &mut Vec<String>) -> Result<usize, ShaderError> {
        const DEEPEST: usize = 16;
        if self.text(start) != ":" || self.text(start + 1) != ":" || path.len() > DEEPEST {
            return Err(self.error(ErrorKind::Syntax, start, "an import wants `::` and a name here"));
        }
        let i = start + 2;
        if self.text(i) != "{" {
            return self.import_tree(i, path);
        }
        let mut i = i + 1;
        while self.text(i) != "}" {
            i = self.import_tree(i, path)?;
            match self.text(i) {
                "," => i += 1,
                "}" => {}
                _ => return Err(self.error(ErrorKind::Syntax, i, "an import's list wants `,` or `}` here")),
            }
        }
        Ok(i + 1)
    }

    /// Reads a name, and the path behind it if there is one.
    fn import_tree(&mut self, i: usize, path: &mut Vec<String>) -> Result<usize, ShaderError> {
        if !self.is_word(i) {
            return Err(self.error(ErrorKind::Syntax, i, "an import wants a name here"));
        }
        if self.text(i + 1) == ":" {
            path.push(self.text(i).to_owned());
            let end = self.import_path(i + 1, path)?;
            path.pop();
            return Ok(end);
        }
        if path.is_empty() {
            return Err(self.error(ErrorKind::Import, i, "an import names a module and what it takes from it"));
        }
        self.module.imports.push(Import { module: path.join("/"), item: self.named(i) });
        Ok(i + 1)
    }
}
