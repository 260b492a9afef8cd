//! The declarations of a generated program, for generating its other parts.

/// A type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    Bool,
    Int,
    Float,
    String,
    Point,
    Time,
    Duration,
    Robot,
    Area,
    Obstacles,
    /// An enum, by its number.
    Enum(usize),
    /// A record or a message, by its number.
    Record(usize),
    Tuple(Vec<Type>),
    List(Box<Type>),
    Set(Box<Type>),
    Map(Box<Type>, Box<Type>),
    Optional(Box<Type>),
}

impl Type {
    pub fn list(element: Type) -> Type {
        Type::List(Box::new(element))
    }

    pub fn set(element: Type) -> Type {
        Type::Set(Box::new(element))
    }

    pub fn map(key: Type, value: Type) -> Type {
        Type::Map(Box::new(key), Box::new(value))
    }

    /// `of?`; an optional type stays the same.
    pub fn optional(of: Type) -> Type {
        match of {
            Type::Optional(_) => of,
            of => Type::Optional(Box::new(of)),
        }
    }

    /// Whether `<` compares values of it.
    pub fn is_ordered(&self) -> bool {
        use Type::{Duration, Float, Int, Robot, String, Time, Tuple};
        match self {
            Tuple(parts) => parts.iter().all(Type::is_ordered),
            _ => matches!(self, Int | Float | String | Time | Duration | Robot),
        }
    }
}

/// A name with its type.
#[derive(Clone, Debug)]
pub struct Named {
    pub name: String,
    pub ty: Type,
}

/// An enum.
pub struct Enum {
    /// None of `enum {a, b}` in place of a type.
    pub name: Option<String>,
    pub variants: Vec<String>,
}

/// A record or a message.
pub struct Record {
    pub name: String,
    pub fields: Vec<Named>,
    pub is_message: bool,
}

/// A shared variable.
pub struct Shared {
    pub name: String,
    pub ty: Type,
    pub is_single_writer: bool,
    pub has_initial: bool,
}

/// A bound primitive.
pub struct Binding {
    pub name: String,
    pub kind: &'static str,
}

/// A function.
#[derive(Clone)]
pub struct Function {
    pub name: String,
    pub parameters: Vec<Named>,
    pub result: Type,
    /// Whether it calls itself; its first parameter, an Int, says how often.
    pub is_recursive: bool,
}

/// A local.
#[derive(Clone)]
pub struct Local {
    pub name: String,
    pub ty: Type,
    pub is_writable: bool,
}

/// Where an expression or a statement stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The value of a constant, or a default.
    Constant,
    /// The first value of a state variable, which sees those before it.
    Initial,
    Function,
    Guard,
    Effect,
    /// A property; whether it is about each robot by itself.
    Property(bool),
}

impl Place {
    /// Whether built-in names of the robot can be asked for.
    pub fn asks(self) -> bool {
        matches!(self, Place::Initial | Place::Guard | Place::Effect)
    }

    /// Whether variables are seen by their names.
    pub fn sees_variables(self) -> bool {
        self.asks() || self == Place::Property(true)
    }

    /// Whether shared variables and primitives are seen.
    pub fn sees_shared(self) -> bool {
        matches!(self, Place::Guard | Place::Effect)
    }

    pub fn is_property(self) -> bool {
        matches!(self, Place::Property(_))
    }
}

/// The declarations.
pub struct Model {
    pub enums: Vec<Enum>,
    pub records: Vec<Record>,
    pub constants: Vec<Named>,
    pub parameters: Vec<Named>,
    pub variables: Vec<Named>,
    pub shared: Vec<Shared>,
    pub bindings: Vec<Binding>,
    pub functions: Vec<Function>,
    /// The enum of the roles, if there are any.
    pub roles: Option<usize>,
}

impl Model {
    /// The built-in declarations.
    pub fn new() -> Model {
        let field = |name: &str, ty| Named {
            name: name.into(),
            ty,
        };
        Model {
            enums: vec![Enum {
                name: Some("Side".into()),
                variants: ["left", "right", "both"].map(String::from).into(),
            }],
            records: vec![Record {
                name: "Detection".into(),
                fields: vec![
                    field("robot", Type::optional(Type::Robot)),
                    field("thing", Type::optional(Type::Int)),
                    field("position", Type::Point),
                ],
                is_message: false,
            }],
            constants: Vec::new(),
            parameters: Vec::new(),
            variables: Vec::new(),
            shared: Vec::new(),
            bindings: Vec::new(),
            functions: Vec::new(),
            roles: None,
        }
    }

    /// A type as it is written.
    pub fn written(&self, ty: &Type) -> String {
        match ty {
            Type::Bool => "Bool".into(),
            Type::Int => "Int".into(),
            Type::Float => "Float".into(),
            Type::String => "String".into(),
            Type::Point => "Point".into(),
            Type::Time => "Time".into(),
            Type::Duration => "Duration".into(),
            Type::Robot => "RobotId".into(),
            Type::Area => "Area".into(),
            Type::Obstacles => "Obstacles".into(),
            Type::Enum(number) => self.enums[*number].name.clone().unwrap_or_default(),
            Type::Record(number) => self.records[*number].name.clone(),
            Type::Tuple(parts) => {
                let parts: Vec<String> = parts.iter().map(|part| self.written(part)).collect();
                format!("({})", parts.join(", "))
            }
            Type::List(element) => format!("List[{}]", self.written(element)),
            Type::Set(element) => format!("Set[{}]", self.written(element)),
            Type::Map(key, value) => {
                format!("Map[{}, {}]", self.written(key), self.written(value))
            }
            Type::Optional(inner) => format!("{}?", self.written(inner)),
        }
    }

    /// Whether values of it can be keys.
    pub fn is_key(&self, ty: &Type) -> bool {
        match ty {
            Type::Bool
            | Type::Int
            | Type::String
            | Type::Robot
            | Type::Time
            | Type::Duration
            | Type::Point
            | Type::Enum(_) => true,
            Type::Record(number) => {
                let mut fields = self.records[*number].fields.iter();
                fields.all(|field| self.is_key(&field.ty))
            }
            Type::Tuple(parts) => parts.iter().all(|part| self.is_key(part)),
            _ => false,
        }
    }

    /// Whether a variable of it needs no first value.
    pub fn has_default(&self, ty: &Type) -> bool {
        match ty {
            Type::Robot | Type::Area => false,
            Type::Record(number) => {
                let mut fields = self.records[*number].fields.iter();
                fields.all(|field| self.has_default(&field.ty))
            }
            Type::Tuple(parts) => parts.iter().all(|part| self.has_default(part)),
            _ => true,
        }
    }
}
