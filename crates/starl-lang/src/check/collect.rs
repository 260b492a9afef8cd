//! Collects the declarations of each file: every name gets its number before any body is checked.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::report::did_you_mean;
use super::scope::{Declared, Entity};
use super::state::{Behaviour, Checker, Progress, RecordNode};
use super::tables::Primitive;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::ir::*;
use crate::syntax::ast::{self, AstNode, Documented, Item, Named};

/// How many variants an enum may have.
const MOST_VARIANTS: usize = 1000;

impl Checker {
    /// Notes all declarations of all files.
    pub fn collect(&mut self) {
        let tree = self.files[0].checked.parse.tree();
        self.program.name.clone_from(&self.files[0].checked.name);
        self.program.is_library = tree.items().any(|item| matches!(item, Item::Library(_)));
        self.collect_role_variable(&tree);
        for file in 0..self.files.len() {
            self.file = file as u32;
            let tree = self.files[file].checked.parse.tree();
            let is_library = tree.items().any(|item| matches!(item, Item::Library(_)));
            for item in tree.items() {
                if (is_library || file > 0) && !self.may_be_in_library(&item) {
                    // Uses of this name are not reported again.
                    if let Some(name) = item_name(&item) {
                        self.declare(&name, Entity::Broken);
                    }
                    continue;
                }
                self.collect_item(item, None);
            }
        }
        self.file = 0;
    }

    fn may_be_in_library(&mut self, item: &Item) -> bool {
        let what = match item {
            Item::Parameter(_) => "parameters",
            Item::Variable(_) | Item::Shared(_) => "variables",
            Item::Binding(_) => "primitives",
            Item::Init(_) => "`init`",
            Item::Action(_) => "actions",
            Item::Handler(_) => "handlers",
            Item::Role(_) => "roles",
            Item::Property(_) => "properties",
            Item::Check(_) => "checks",
            _ => return true,
        };
        let message = format!("a library has no {what}");
        let problem = Diagnostic::new(Code::NotInLibrary, first_word(item.syntax()), message);
        self.report(problem.note("it has enums, records, messages, constants and functions"));
        false
    }

    /// The variable `role` and the enum of the roles come first, if there are any.
    fn collect_role_variable(&mut self, tree: &ast::SourceFile) {
        let mut roles: Vec<(ast::RoleDeclaration, Name)> = Vec::new();
        for item in tree.items() {
            let Item::Role(role) = item else { continue };
            let Some(name) = name_of(&role) else { continue };
            if let Some((_, first)) = roles.iter().find(|(_, other)| other.text == name.text) {
                self.duplicate("roles", &name.text, name.span, first.span);
                continue;
            }
            roles.push((role, name));
        }
        let Some((_, first)) = roles.first() else {
            return;
        };
        let site = self.site(first.span);
        let variants = (roles.iter())
            .map(|(_, name)| (name.text.clone(), name.span))
            .collect();
        let id = self.add_enum(Some("role".into()), variants, site, String::new(), None);
        self.program.variables.push(Variable {
            name: "role".into(),
            ty: Type::Enum(id),
            initial: None,
            locals: Vec::new(),
            role: None,
            is_stable: false,
            site,
            documentation: "The role that this robot has.".into(),
        });
        self.nodes.variables.push(None);
        let described = |(role, name): &(ast::RoleDeclaration, Name)| Role {
            name: name.text.clone(),
            entry: None,
            site: self.site(name.span),
            documentation: Item::Role(role.clone()).documentation(),
        };
        self.program.roles = Some(Roles {
            variable: VariableId(0),
            roles: roles.iter().map(described).collect(),
        });
        self.nodes.roles = roles.into_iter().map(|(role, _)| role).collect();
    }

    fn collect_item(&mut self, item: Item, role: Option<u16>) {
        let documentation = item.documentation();
        match item {
            Item::Program(_) | Item::Library(_) => {}
            Item::Import(node) => self.collect_import(&node),
            Item::Enum(node) => self.collect_enum(node, documentation),
            Item::Record(node) => {
                let Some(name) = name_of(&node) else { return };
                self.add_record(RecordNode::Record(node), name, false, documentation);
            }
            Item::Message(node) => {
                let Some(name) = name_of(&node) else { return };
                self.add_record(RecordNode::Message(node), name, true, documentation);
            }
            Item::Parameter(node) => {
                let Some(name) = name_of(&node) else { return };
                let id = ParameterId(self.program.parameters.len() as u32);
                self.declare(&name, Entity::Parameter(id));
                self.program.parameters.push(Parameter {
                    name: name.text,
                    ty: Type::Error,
                    default: None,
                    range: None,
                    locals: Vec::new(),
                    site: self.site(name.span),
                    documentation,
                });
                self.nodes.parameters.push(node);
            }
            Item::Constant(node) => {
                let Some(name) = name_of(&node) else { return };
                let id = ConstantId(self.program.constants.len() as u32);
                self.declare(&name, Entity::Constant(id));
                let site = self.site(name.span);
                self.program.constants.push(Constant {
                    name: name.text,
                    ty: Type::Error,
                    value: super::report::broken(name.span),
                    locals: Vec::new(),
                    site,
                    documentation,
                });
                self.constants.push(Progress::Untouched);
                self.nodes.constants.push((self.file, node));
            }
            Item::Variable(node) => {
                let Some(name) = name_of(&node) else { return };
                let id = VariableId(self.program.variables.len() as u32);
                self.declare(&name, Entity::Variable(id));
                self.program.variables.push(Variable {
                    name: name.text,
                    ty: Type::Error,
                    initial: None,
                    locals: Vec::new(),
                    role,
                    is_stable: node.is_stable(),
                    site: self.site(name.span),
                    documentation,
                });
                self.nodes.variables.push(Some(node));
            }
            Item::Shared(node) => self.collect_shared(node, documentation),
            Item::Binding(node) => self.collect_binding(node, documentation),
            Item::Function(node) => {
                let Some(name) = name_of(&node) else { return };
                let id = FunctionId(self.program.functions.len() as u32);
                self.declare(&name, Entity::Function(id));
                self.program.functions.push(Function {
                    name: name.text,
                    parameters: 0,
                    locals: Vec::new(),
                    result: Type::Error,
                    body: Vec::new(),
                    site: self.site(name.span),
                    documentation,
                });
                self.nodes.functions.push((self.file, node));
            }
            Item::Init(node) => self.nodes.behaviour.push(Behaviour::Init(role, node)),
            Item::Action(node) => {
                self.actions.extend(node.name().map(|name| name.text()));
                self.nodes.behaviour.push(Behaviour::Action(role, node));
            }
            Item::Handler(node) => self.nodes.behaviour.push(Behaviour::Handler(role, node)),
            Item::Check(node) => self.nodes.behaviour.push(Behaviour::Check(node)),
            Item::Property(node) => self.nodes.behaviour.push(Behaviour::Property(node)),
            Item::Role(node) => {
                // A second role of a name counts as the first.
                let name = node.name().map(|name| name.text());
                let roles = self.program.roles.iter().flat_map(|roles| &roles.roles);
                let number = roles
                    .into_iter()
                    .position(|role| Some(&role.name) == name.as_ref());
                for inner in node.items() {
                    if !matches!(inner, Item::Role(_)) {
                        self.collect_item(inner, number.map(|number| number as u16));
                    }
                }
            }
        }
    }

    fn collect_import(&mut self, node: &ast::Import) {
        let Some(name) = name_of(node) else { return };
        let imported = self.files[self.file as usize].imports.get(&name.text);
        let entity = imported.map_or(Entity::Broken, |file| Entity::Library(*file));
        self.resolve_entity(name.span, entity);
        self.declare(&name, entity);
    }

    fn collect_enum(&mut self, node: ast::EnumDeclaration, documentation: String) {
        let Some(name) = name_of(&node) else { return };
        let variants = self.variant_names(node.variants());
        let site = self.site(name.span);
        let text = Some(name.text.clone());
        let id = self.add_enum(text, variants, site, documentation, Some(node));
        self.declare(&name, Entity::Enum(id));
    }

    /// The names of variants, each once.
    pub fn variant_names(&mut self, names: impl Iterator<Item = ast::Name>) -> Vec<(String, Span)> {
        let mut variants: Vec<(String, Span)> = Vec::new();
        for name in names {
            let (text, span) = (name.text(), name.span());
            if let Some((_, first)) = variants.iter().find(|(other, _)| *other == text) {
                self.duplicate("variants", &text, span, *first);
            } else {
                variants.push((text, span));
            }
        }
        variants
    }

    /// Adds an enum to the program.
    pub fn add_enum(
        &mut self,
        name: Option<String>,
        variants: Vec<(String, Span)>,
        site: Site,
        documentation: String,
        node: Option<ast::EnumDeclaration>,
    ) -> EnumId {
        let id = EnumId(self.program.enums.len() as u32);
        let mut variants = variants;
        if variants.len() > MOST_VARIANTS {
            let message = format!("an enum has at most {MOST_VARIANTS} variants");
            self.error(Code::TooLarge, site.span, message);
            variants.truncate(MOST_VARIANTS);
        }
        for (number, (variant, _)) in variants.iter().enumerate() {
            let those = self.variants.entry(variant.clone()).or_default();
            those.push((id, number as u16));
        }
        let variants = (variants.into_iter())
            .map(|(name, span)| Variant {
                name,
                site: Site { span, ..site },
            })
            .collect();
        self.program.enums.push(Enum {
            name,
            variants,
            site,
            documentation,
        });
        self.nodes.enums.push(node);
        id
    }

    fn add_record(
        &mut self,
        node: RecordNode,
        name: Name,
        is_message: bool,
        documentation: String,
    ) {
        let id = RecordId(self.program.records.len() as u32);
        self.declare(&name, Entity::Record(id));
        self.program.records.push(Record {
            name: name.text,
            is_message,
            fields: Vec::new(),
            site: self.site(name.span),
            documentation,
        });
        self.nodes.records.push(node);
    }

    fn collect_shared(&mut self, node: ast::SharedDeclaration, documentation: String) {
        let Some(name) = name_of(&node) else { return };
        let id = SharedId(self.program.shared.len() as u32);
        self.declare(&name, Entity::Shared(id));
        let consistency = self.consistency(&node);
        self.program.shared.push(Shared {
            name: name.text,
            is_single_writer: node.is_single_writer(),
            consistency,
            ty: Type::Error,
            initial: None,
            locals: Vec::new(),
            site: self.site(name.span),
            documentation,
        });
        self.nodes.shared.push(node);
    }

    /// The consistency that a shared variable names.
    fn consistency(&mut self, node: &ast::SharedDeclaration) -> Consistency {
        let Some(word) = node.consistency() else {
            return Consistency::default();
        };
        let (name, span) = (word.text(), Span::from(word.text_range()));
        let mut known = Consistency::ALL.into_iter();
        let Some(found) = known.find(|consistency| consistency.name() == name) else {
            let message = format!("there is no consistency `{name}`");
            let problem = Diagnostic::new(Code::UnknownConsistency, span, message);
            let names = Consistency::ALL.map(Consistency::name);
            let problem = did_you_mean(problem, span, name, names.iter().copied());
            self.report(match problem.fix {
                None => problem.note("there are `eventual`, `causal` and `linearizable`"),
                Some(_) => problem,
            });
            return Consistency::default();
        };
        if found == Consistency::Linearizable && node.is_single_writer() {
            let message = "an `allread` variable cannot be linearizable";
            let problem = Diagnostic::new(Code::UnknownConsistency, span, message);
            self.report(problem.note(
                "it is as many variables as there are robots; one of all is an `allwrite` with a `Map`",
            ));
            return Consistency::default();
        }
        found
    }

    fn collect_binding(&mut self, node: ast::BindingDeclaration, documentation: String) {
        let Some(name) = name_of(&node) else { return };
        let id = BindingId(self.program.bindings.len() as u32);
        let constructor = super::declaration::constructor(&node);
        let primitive = constructor.and_then(|(word, _)| Primitive::named(&word));
        // Where it is not a primitive, which is reported, it may be meant as a variable.
        let entity = primitive.map_or(Entity::Broken, |_| Entity::Binding(id));
        self.declare(&name, entity);
        self.program.bindings.push(Binding {
            name: name.text,
            primitive,
            arguments: Vec::new(),
            locals: Vec::new(),
            site: self.site(name.span),
            documentation,
        });
        self.nodes.bindings.push(node);
    }

    /// Gives a name its meaning in the present file.
    fn declare(&mut self, name: &Name, entity: Entity) {
        let reserved = Type::built_in(&name.text).is_some()
            || matches!(name.text.as_str(), "List" | "Set" | "Map" | "role")
            || Primitive::named(&name.text).is_some();
        if reserved {
            let message = format!("`{}` is a built-in name", name.text);
            let problem = Diagnostic::new(Code::DuplicateName, name.span, message);
            self.report(problem.note("choose another name"));
            return;
        }
        let scope = &mut self.files[self.file as usize].scope;
        let declared = Declared {
            entity,
            span: name.span,
        };
        let Some(first) = scope.get(&name.text) else {
            scope.insert(name.text.clone(), declared);
            return;
        };
        let (what, span) = (first.entity.what(), first.span);
        let message = format!("the name `{}` is taken", name.text);
        let problem = Diagnostic::new(Code::DuplicateName, name.span, message);
        self.report(problem.label(span, format!("it is {what} here")));
    }

    /// A place in the present file.
    pub fn site(&self, span: Span) -> Site {
        Site {
            file: self.file,
            span,
        }
    }
}

/// A name with its place.
pub(super) struct Name {
    pub text: String,
    pub span: Span,
}

/// The name that a declaration gives, unless it is missing.
pub(super) fn name_of(node: &impl Named) -> Option<Name> {
    let name = node.name()?;
    let token = name.token()?;
    Some(Name {
        text: token.text().into(),
        span: token.text_range().into(),
    })
}

/// The name by which others use what is declared.
fn item_name(item: &Item) -> Option<Name> {
    match item {
        Item::Message(node) => name_of(node),
        Item::Parameter(node) => name_of(node),
        Item::Variable(node) => name_of(node),
        Item::Shared(node) => name_of(node),
        Item::Binding(node) => name_of(node),
        _ => None,
    }
}

/// The first word of a declaration.
pub(super) fn first_word(node: &crate::syntax::SyntaxNode) -> Span {
    let tokens = node
        .descendants_with_tokens()
        .filter_map(rowan::NodeOrToken::into_token);
    let first = tokens.into_iter().find(|token| !token.kind().is_trivia());
    first.map_or(Span::from(node.text_range()), |token| {
        Span::from(token.text_range())
    })
}
