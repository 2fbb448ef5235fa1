//! Joins a module with what it imports into one text, and keeps where each byte came from.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

use super::error::{ErrorKind, Place, ShaderError, Source};
use super::generated::Generated;
use super::library::Library;
use super::module::{Import, Module};
use super::{Features, check, token};

/// A module with all it imports: parsed, valid, and rid of what no entry point uses.
#[derive(Debug)]
pub struct Linked {
    pub module: naga::Module,
    pub info: naga::valid::ModuleInfo,
    /// The WGSL that was parsed: each module whole, with spaces for what is not WGSL or switched off.
    pub text: String,
    /// The names of the modules it was made of, itself included, `gen` not.
    pub imports: BTreeSet<String>,
    /// The enabled features that any condition in it names: two links of a module with equal features have equal text.
    pub features: Features,
}

impl Linked {
    /// Whether both texts are the same up to comments and white space.
    pub fn is_same_code(&self, other: &Linked) -> bool {
        self.words().zip(other.words()).is_some_and(|(own, others)| own == others)
    }

    /// The text's tokens; none if it has none, which no text that was parsed is.
    fn words(&self) -> Option<Vec<&str>> {
        let source = Arc::new(Source { file: String::new(), text: self.text.clone() });
        let tokens = token::tokenize(&source).ok()?;
        tokens.into_iter().map(|token| self.text.get(token.range)).collect()
    }
}

/// Links a module of a library.
pub fn link(library: &Library, root: &str, features: &Features) -> Result<Linked, ShaderError> {
    let closure = Closure::gather(library, root, features)?;
    let owners = closure.owners()?;
    closure.check_uses(&owners)?;
    let (text, map) = closure.join();
    let (module, info) = check::check(&text, &map, &closure.generated, library, features)?;
    let named = closure.modules.iter().flat_map(|(_, module)| &module.features);
    Ok(Linked {
        module,
        info,
        imports: closure.modules.iter().map(|(name, _)| name.clone()).collect(),
        features: named.filter(|name| features.contains(*name)).cloned().collect(),
        text,
    })
}

/// A module and all it imports, each behind what it imports itself.
struct Closure {
    modules: Vec<(String, Module)>,
    generated: Generated,
}

impl Closure {
    fn gather(library: &Library, root: &str, features: &Features) -> Result<Closure, ShaderError> {
        let mut walk = Walk { library, features, path: Vec::new(), done: Vec::new() };
        walk.visit(root)?;
        let modules = walk.done;
        let imports = modules.iter().flat_map(|(_, module)| &module.imports);
        let names = imports.filter(|import| import.module == "gen").map(|import| import.item.name.as_str()).collect();
        Ok(Closure { generated: library.shared().generate(&names), modules })
    }

    /// Which module declares each name: a place in `modules`, or None for the generated one.
    fn owners(&self) -> Result<BTreeMap<&str, Option<usize>>, ShaderError> {
        let mut owners = BTreeMap::new();
        let mut places: BTreeMap<&str, Place> = BTreeMap::new();
        for name in &self.generated.names {
            owners.insert(name.as_str(), None);
            places.insert(name, Place::new(self.generated.source.clone(), 0..0));
        }
        for (index, (_, module)) in self.modules.iter().enumerate() {
            for declared in &module.declarations {
                let name = declared.name.as_str();
                if let Some(first) = places.get(name) {
                    let at = format!("{}:{}:{}", first.source.file, first.line, first.column);
                    let message = format!("`{name}` is declared twice: first at {at}");
                    return Err(ShaderError::at(ErrorKind::Duplicate, &module.source, declared.range.clone(), message));
                }
                owners.insert(name, Some(index));
                places.insert(name, Place::new(module.source.clone(), declared.range.clone()));
            }
        }
        Ok(owners)
    }

    /// Refuses a name of another module that is used without an import. Names that the module also declares somewhere
    /// inside a function or struct pass, since no scopes are known here.
    fn check_uses(&self, owners: &BTreeMap<&str, Option<usize>>) -> Result<(), ShaderError> {
        for (index, (_, module)) in self.modules.iter().enumerate() {
            let imported: BTreeSet<&str> = module.imports.iter().map(|import| import.item.name.as_str()).collect();
            for used in &module.uses {
                let name = used.name.as_str();
                let Some(&owner) = owners.get(name) else { continue };
                if owner == Some(index) || imported.contains(name) || module.locals.contains(name) {
                    continue;
                }
                let path = owner.map_or("gen".to_owned(), |owner| self.modules[owner].0.replace('/', "::"));
                let message = format!("`{name}` is not imported here");
                return Err(ShaderError::at(ErrorKind::Import, &module.source, used.range.clone(), message)
                    .help(format!("import package::{path}::{name};")));
            }
        }
        Ok(())
    }

    /// One text: directives, generated declarations, modules.
    fn join(&self) -> (String, SourceMap) {
        let mut text = String::new();
        let mut map = SourceMap { pieces: Vec::new() };
        for (_, module) in &self.modules {
            for range in &module.directives {
                map.append(&mut text, &module.source.text[range.clone()], &module.source, range.start);
            }
        }
        map.append(&mut text, &self.generated.source.text, &self.generated.source, 0);
        for (_, module) in &self.modules {
            map.append(&mut text, &module.text, &module.source, 0);
        }
        (text, map)
    }
}

/// The way through the imports, depth first.
struct Walk<'a> {
    library: &'a Library,
    features: &'a Features,
    /// The modules that are being visited, outermost first.
    path: Vec<String>,
    done: Vec<(String, Module)>,
}

impl Walk<'_> {
    fn visit(&mut self, name: &str) -> Result<(), ShaderError> {
        let module = self.library.scan(name, self.features)?;
        self.path.push(name.to_owned());
        for import in &module.imports {
            self.follow(&module.source, import)?;
        }
        self.path.pop();
        self.done.push((name.to_owned(), module));
        Ok(())
    }

    fn follow(&mut self, source: &Arc<Source>, import: &Import) -> Result<(), ShaderError> {
        let Import { module, item } = import;
        let error = |kind, message: String| ShaderError::at(kind, source, item.range.clone(), message);
        if module == "gen" {
            if self.library.shared().knows(&item.name) {
                return Ok(());
            }
            return Err(error(ErrorKind::Import, format!("package::gen has no struct or constant `{}`", item.name)));
        }
        if let Some(start) = self.path.iter().position(|name| name == module) {
            let cycle = format!("{} -> {module}", self.path[start..].join(" -> "));
            return Err(error(ErrorKind::Cycle, format!("these modules import each other: {cycle}")));
        }
        if !self.library.has(module) {
            let missing = error(ErrorKind::Import, format!("there is no module `{module}`"));
            let whole = format!("{module}/{}", item.name);
            return Err(if self.library.has(&whole) {
                missing.help(format!("`{whole}` is a module: name what to take from it"))
            } else {
                missing
            });
        }
        if !self.done.iter().any(|(name, _)| name == module) {
            self.visit(module).map_err(|mut inner| {
                if inner.place.is_none() {
                    inner.place = Some(Box::new(Place::new(source.clone(), item.range.clone())));
                }
                inner
            })?;
        }
        let imported = self.done.iter().find(|(name, _)| name == module);
        if imported.is_some_and(|(_, scanned)| scanned.declarations.iter().any(|known| known.name == item.name)) {
            return Ok(());
        }
        Err(error(ErrorKind::Import, format!("`{module}` declares no `{}` under these features", item.name)))
    }
}

/// Where the bytes of a joined text came from.
pub struct SourceMap {
    /// In order of `start`.
    pieces: Vec<Piece>,
}

struct Piece {
    /// Bytes of the joined text.
    range: Range<usize>,
    source: Arc<Source>,
    /// Where the piece starts in the source.
    offset: usize,
}

impl SourceMap {
    fn append(&mut self, text: &mut String, piece: &str, source: &Arc<Source>, offset: usize) {
        let start = text.len();
        text.push_str(piece);
        self.pieces.push(Piece { range: start..text.len(), source: source.clone(), offset });
        text.push('\n');
    }

    /// The source and its range behind a range of the joined text, cut at the end of the source.
    pub fn origin(&self, range: Range<usize>) -> (&Arc<Source>, Range<usize>) {
        let index = self.pieces.partition_point(|piece| piece.range.start <= range.start).saturating_sub(1);
        let piece = &self.pieces[index];
        let map = |at: usize| at.clamp(piece.range.start, piece.range.end) - piece.range.start + piece.offset;
        (&piece.source, map(range.start)..map(range.end))
    }

    /// An error at a range of the joined text.
    pub fn error(&self, kind: ErrorKind, range: Range<usize>, message: impl Into<String>) -> ShaderError {
        let (source, range) = self.origin(range);
        ShaderError::at(kind, source, range, message)
    }
}
