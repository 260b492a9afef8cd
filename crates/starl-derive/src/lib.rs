//! Derives `starl_core::Primitives`: a type shows the primitives among its fields, in the order of the fields.
//!
//! The macro sees types as they are written, not what they stand for. So it opens the containers that it knows
//! by name, and for the types in them writes code that picks by type what to do: see
//! `starl_core::primitives::field`. No type is passed over without a reason, so no primitive can be.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote, quote_spanned};
use syn::spanned::Spanned;
use syn::{
    Data, DeriveInput, Error, Fields, GenericArgument, PathArguments, Type, parse_macro_input,
};

/// Implements `Primitives`; its documentation has the rules.
#[proc_macro_derive(Primitives)]
pub fn primitives(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    let code = expand(&input).unwrap_or_else(Error::into_compile_error);
    code.into()
}

fn expand(input: &DeriveInput) -> Result<TokenStream, Error> {
    let arms: TokenStream = match &input.data {
        Data::Struct(data) => arm(&quote!(Self), &data.fields),
        Data::Enum(data) => {
            let variants = data.variants.iter();
            let arms = variants.map(|variant| {
                let name = &variant.ident;
                arm(&quote!(Self::#name), &variant.fields)
            });
            arms.collect()
        }
        Data::Union(data) => {
            let message = "a union is not allowed: its valid field is unknown";
            return Err(Error::new(data.union_token.span(), message));
        }
    };
    let name = &input.ident;
    let (generics, arguments, bounds) = input.generics.split_for_impl();
    Ok(quote! {
        impl #generics ::starl_core::Primitives for #name #arguments #bounds {
            #[allow(unused_variables, unreachable_code)]
            fn primitives(
                &mut self,
                visit: &mut dyn ::core::ops::FnMut(&mut dyn ::starl_core::Primitive),
            ) {
                #[allow(unused_imports)]
                use ::starl_core::primitives::field::{Copied as _, Probe, Unknown as _, Visited as _};
                match *self { #arms }
            }
        }
    })
}

/// Takes the fields of a struct or variant apart and shows each.
fn arm(constructor: &TokenStream, fields: &Fields) -> TokenStream {
    let members = fields.members();
    let types = fields.iter().map(|field| &field.ty);
    let names = names("field", types);
    let shown = names
        .iter()
        .zip(fields)
        .map(|(name, field)| show(&quote!(#name), &field.ty));
    quote! {
        #constructor { #(#members: ref mut #names),* } => { #(#shown)* }
    }
}

/// Names for values of these types. They stand where the types do, so that errors do too.
fn names<'t>(stem: &str, types: impl Iterator<Item = &'t Type>) -> Vec<Ident> {
    let name =
        |(place, written): (usize, &Type)| format_ident!("{stem}_{place}", span = written.span());
    types.enumerate().map(name).collect()
}

/// Shows the primitives behind `place`, a `&mut` to a value of this type.
fn show(place: &TokenStream, written: &Type) -> TokenStream {
    let each = |items: TokenStream, item: &Type| {
        let name = Ident::new("item", item.span());
        let shown = show(&quote!(#name), item);
        quote!(for #name in #items { #shown })
    };
    match written {
        Type::Paren(inner) => show(place, &inner.elem),
        Type::Group(inner) => show(place, &inner.elem),
        Type::Array(array) => each(quote!(#place.iter_mut()), &array.elem),
        Type::Slice(slice) => each(quote!(#place.iter_mut()), &slice.elem),
        Type::Tuple(tuple) => {
            let names = names("part", tuple.elems.iter());
            let shown = names
                .iter()
                .zip(&tuple.elems)
                .map(|(name, part)| show(&quote!(#name), part));
            quote!({ let (#(#names,)*) = &mut *#place; #(#shown)* })
        }
        _ => match container(written) {
            Some((name, arguments)) => match (&*name.to_string(), &arguments[..]) {
                ("Option" | "Vec" | "VecDeque", [item]) => each(quote!(#place.iter_mut()), item),
                ("BTreeMap", [_, item]) => each(quote!(#place.values_mut()), item),
                // A primitive in a set could never be called.
                ("BTreeSet", [_]) => TokenStream::new(),
                ("Box", [item]) => {
                    let name = Ident::new("item", item.span());
                    let shown = show(&quote!(#name), item);
                    quote!({ let #name = &mut **#place; #shown })
                }
                _ => leaf(place, written),
            },
            None => leaf(place, written),
        },
    }
}

/// Leaves it to the type's traits.
fn leaf(place: &TokenStream, written: &Type) -> TokenStream {
    quote_spanned!(written.span()=> (&&&Probe::of(&*#place)).way().show(&mut *#place, &mut *visit);)
}

/// The name of a generic type and the types that it is given.
fn container(written: &Type) -> Option<(&Ident, Vec<&Type>)> {
    let Type::Path(path) = written else {
        return None;
    };
    let last = path.path.segments.last()?;
    let PathArguments::AngleBracketed(arguments) = &last.arguments else {
        return None;
    };
    let types = arguments.args.iter().filter_map(|argument| match argument {
        GenericArgument::Type(argument) => Some(argument),
        _ => None,
    });
    Some((&last.ident, types.collect()))
}
