//! Whether the words of a command mean something: its program, its places, what it reads.

use super::binder::Binder;
use super::written::{Node, Spanned};
use programs::Importer;
use programs::{Piece, Template, laid_out};
use stage::{Artifact, Files, PortSpec, unknown};

impl Binder<'_> {
    /// Whether a command starts with a fixed program, and not with what may change.
    pub(super) fn started(&mut self, spanned: &[Spanned<String>], words: &[Template]) {
        let (Some(spanned), Some(first)) = (spanned.first(), words.first()) else {
            return;
        };
        let fixed = |piece: &Piece| matches!(piece, Piece::Text(_) | Piece::Here);
        if first.written.is_empty() || !first.pieces.iter().all(fixed) {
            let what = "the program itself is in the command: a name in PATH, a whole path, or {here}/NAME";
            self.wrong_at(spanned, what);
        } else if let Piece::Text(text) = &first.pieces[0]
            && text.contains('/')
            && !text.starts_with('/')
        {
            let what = format!(
                "the program works in a folder of its own: write {{here}}/{text} and name it in `files`, or give the whole path"
            );
            self.wrong_at(spanned, what);
        }
    }

    /// An identity reads nothing and has no params.
    pub(super) fn plain(&mut self, spanned: &[Spanned<String>], words: &[Template]) {
        let fits = |piece: &Piece| matches!(piece, Piece::Text(_) | Piece::Here);
        for (spanned, word) in spanned.iter().zip(words) {
            if !word.pieces.iter().all(fits) {
                self.wrong_at(spanned, "an identity has no placeholder but {here}");
            }
        }
    }

    /// Whether all places of a command are there, and all params are in it.
    pub(super) fn placed(
        &mut self,
        node: &Node,
        spanned: &[Spanned<String>],
        words: &[Template],
        ports: &[PortSpec],
    ) {
        let names: Vec<&str> = ports.iter().map(|p| p.name).collect();
        let params: Vec<&str> = node.with.iter().map(|(k, _)| k.value.as_str()).collect();
        let mut out = false;
        for (spanned, piece) in spanned
            .iter()
            .zip(words)
            .flat_map(|(s, w)| w.pieces.iter().map(move |p| (s, p)))
        {
            match piece {
                Piece::From(port, format) => match ports.iter().find(|p| p.name == port) {
                    None => self.wrong_at(spanned, unknown("port", port, &names)),
                    Some(PortSpec {
                        kind: "nothing", ..
                    }) => {}
                    Some(spec) => {
                        if let Err(what) = laid_out(self.catalog, spec.kind, format.as_deref()) {
                            self.wrong_at(spanned, format!("`{port}`: {what}"));
                        }
                    }
                },
                Piece::With(param) if !params.contains(&param.as_str()) => {
                    self.wrong_at(spanned, unknown("param", param, &params));
                }
                Piece::Out => out = true,
                _ => {}
            }
        }
        if !out && spanned.len() == words.len() {
            self.wrong_at(
                &spanned[0],
                "the command does not name the place of the result: write {out}",
            );
        }
        for (param, _) in &node.with {
            let has = |w: &Template| w.pieces.contains(&Piece::With(param.value.clone()));
            if !words.iter().any(has) {
                let what = format!("the command has no {{with.{}}}", param.value);
                self.wrong_at(param, what);
            }
        }
    }

    /// Reports sources that nobody reads, and those that the importer lacks.
    pub(super) fn unread(
        &mut self,
        node: &Node,
        importer: &Importer,
        words: &[Template],
        ports: &[PortSpec],
    ) {
        let catalog = self.catalog;
        let pieces = || words.iter().flat_map(|w| &w.pieces);
        let laid = |port: &str| pieces().any(|p| matches!(p, Piece::From(name, _) if name == port));
        let wants = importer.stage.ports();
        let beside = |kind: &str| {
            let names = |p: &PortSpec| {
                let of = catalog.kind(p.kind).and_then(|k| k.beside);
                laid(p.name) && of == Some(kind)
            };
            let wanted = wants.iter().any(|w| w.kind == kind);
            wanted && kind != Files::KIND || ports.iter().any(names)
        };
        for port in ports.iter().filter(|p| !laid(p.name) && !beside(p.kind)) {
            let what = format!("the command has no {{from.{}}}", port.name);
            self.wrong_at(&node.name, format!("node `{}`: {what}", node.name.value));
        }
        let known = ports.iter().all(|p| p.kind != "nothing");
        for want in wants
            .iter()
            .filter(|w| known && !w.optional && w.kind != Files::KIND)
        {
            if !ports.iter().any(|p| p.kind == want.kind) {
                let kind = importer.stage.yields();
                let what = format!(
                    "{kind} are read with {}: let it read them too, `from = {{ {} = \"...\" }}`",
                    want.kind, want.name
                );
                self.wrong_at(&node.name, format!("node `{}`: {what}", node.name.value));
            }
        }
    }
}
