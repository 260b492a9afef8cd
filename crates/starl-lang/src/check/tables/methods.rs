//! Methods of built-in types.

use super::Signature;

words! {
    /// A method of a built-in type.
    Method,
    /// All methods.
    METHODS,
    /// Whether it changes its receiver.
    changes: bool;

    ListSize = "List[T].size() -> Int" false "The number of elements."
    ListAdd = "List[T].add(element: T)" true "Adds an element at the end."
    ListInsert = "List[T].insert(index: Int, element: T)" true "Inserts an element before the one at the index; a run-time error if the index is out of range."
    ListRemoveAt = "List[T].remove_at(index: Int)" true "Removes the element at the index; a run-time error if the index is out of range."
    ListRemove = "List[T].remove(element: T)" true "Removes the first equal element, if any."
    ListContains = "List[T].contains(element: T) -> Bool" false "Whether the list has an equal element."
    ListFirst = "List[T].first() -> T?" false "The first element; none for an empty list."
    ListLast = "List[T].last() -> T?" false "The last element; none for an empty list."
    ListIndexOf = "List[T].index_of(element: T) -> Int?" false "The index of the first equal element; none if there is none."
    ListReversed = "List[T].reversed() -> List[T]" false "The elements in reverse order."
    ListSorted = "List[O].sorted() -> List[O]" false "The elements in ascending order."
    ListSlice = "List[T].slice(start: Int, end: Int) -> List[T]" false "The elements from `start` to before `end`; a run-time error if they are out of range."
    ListSum = "List[N].sum() -> N" false "The sum of the elements."
    ListJoin = "List[String].join(separator: String) -> String" false "The texts in order, with the separator between them."
    SetSize = "Set[T].size() -> Int" false "The number of elements."
    SetAdd = "Set[T].add(element: T)" true "Adds an element if it is missing."
    SetRemove = "Set[T].remove(element: T)" true "Removes an element if it is present."
    SetContains = "Set[T].contains(element: T) -> Bool" false "Whether the element is present."
    SetUnion = "Set[T].union(other: Set[T]) -> Set[T]" false "The elements of either set."
    SetIntersection = "Set[T].intersection(other: Set[T]) -> Set[T]" false "The elements of both sets."
    SetDifference = "Set[T].difference(other: Set[T]) -> Set[T]" false "The elements that are not in the other set."
    SetMin = "Set[T].min() -> T?" false "The smallest element; none for an empty set."
    SetMax = "Set[T].max() -> T?" false "The greatest element; none for an empty set."
    MapSize = "Map[K, V].size() -> Int" false "The number of keys."
    MapGet = "Map[K, V].get(key: K) -> V?" false "The value of the key; none if it is missing."
    MapKeys = "Map[K, V].keys() -> Set[K]" false "The keys."
    MapValues = "Map[K, V].values() -> List[V]" false "The values, in the order of the keys."
    MapRemove = "Map[K, V].remove(key: K)" true "Removes the key and its value if present."
    MapContains = "Map[K, V].contains(key: K) -> Bool" false "Whether the key is present."
    StringSize = "String.size() -> Int" false "The number of characters."
    StringStartsWith = "String.starts_with(part: String) -> Bool" false "Whether the text begins with the part."
    StringEndsWith = "String.ends_with(part: String) -> Bool" false "Whether the text ends with the part."
    StringLower = "String.lower() -> String" false "The text in small letters."
    StringUpper = "String.upper() -> String" false "The text in capital letters."
    StringTrim = "String.trim() -> String" false "The text without white space at its start and end."
    StringReplace = "String.replace(part: String, by: String) -> String" false "The text with `by` in place of each part; the same text if the part is empty."
    StringToInt = "String.to_int() -> Int?" false "The Int that the text is, such as `-12`; none if it is not one."
    StringToFloat = "String.to_float() -> Float?" false "The Float that the text is, such as `2`, `2.5` or `1e-3`; none if it is not a finite number."
    StringContains = "String.contains(part: String) -> Bool" false "Whether the part occurs."
    StringSplit = "String.split(separator: String) -> List[String]" false "The parts between separators."
    AreaContains = "Area.contains(point: Point) -> Bool" false "Whether the point is in the area or on its boundary."
}

impl Method {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        let text = self.text();
        let start = text.find('.').map_or(0, |dot| dot + 1);
        Signature::name_of(&text[start..])
    }

    /// The name of the type that it is a method of, without what that holds.
    #[must_use]
    pub fn receiver_name(self) -> &'static str {
        let text = self.text();
        &text[..text.find(['[', '.']).unwrap_or(0)]
    }

    /// The methods of a type, by the type's name without type arguments.
    pub fn of(receiver: &str) -> impl Iterator<Item = Self> {
        (METHODS.iter().copied()).filter(move |method| method.receiver_name() == receiver)
    }

    /// Whether it adds an element, so that it may be called on the value of a missing key.
    #[must_use]
    pub fn adds(self) -> bool {
        matches!(self, Self::ListAdd | Self::SetAdd)
    }
}
