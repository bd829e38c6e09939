//! The way back from a reduction: the dropped coordinates, and the joint state with them.

use nonholonomic_core::reduction::Reconstruction;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::layout::local;
use super::map_functions::{Map, dropped};
use super::record::Record;
use super::setting::Context;
use super::symbols::{Argument, Scope};

impl Map<'_> {
    /// The dropped coordinates as a struct, the joint state, and `impl Reconstruction`.
    pub(super) fn reconstruction(&self, back: &Reconstruction) -> TokenStream {
        let Context { runtime, scalar, .. } = self.context;
        let (t, state) = (&self.context.locals.t, &self.context.locals.state);
        let (target, joint) = (&self.types.target, local("joint"));
        let dynamics = quote!(#runtime::Dynamics);
        let group = self.group(back);
        let group_type = self.group_type(&group);
        let group_record = (group.len() > 0).then(|| group.emit(self.context));
        let joint_name = self.name_beside("Joint");
        let (joint_struct, joint_type) = self.joint(&joint_name, &group);
        let model = &self.reduction.source;
        let in_state = Scope::new(self.context, model, &self.reduction.state);
        let in_joint = Scope::new(self.context, model, &[])
            .with_places(Argument::State, &back.reduced, self.target.state.places(&quote!(#joint.reduced)))
            .with_places(Argument::State, &back.dropped, group.places(&quote!(#joint.group)));
        let made = |outputs: &[TokenStream]| {
            if outputs.is_empty() {
                return quote!(());
            }
            let length = Literal::usize_unsuffixed(outputs.len());
            quote!(<#group_type as ::core::convert::From<[#scalar; #length]>>::from([#(#outputs),*]))
        };
        // the dropped coordinates are in the state as they are
        let places: Vec<TokenStream> = back
            .dropped
            .iter()
            .filter_map(|symbol| in_state.place(*symbol))
            .map(|(_, place)| place.clone())
            .collect();
        let group_of_state = made(&places);
        let arguments =
            [(Argument::This, quote!(self)), (Argument::Time, quote!(#t)), (Argument::State, quote!(#joint))];
        let rates = self.body(&in_joint, &back.rates);
        let (drop_rates, rate_statements, rates) =
            (dropped(&rates.used, &arguments), &rates.statements, made(&rates.outputs));
        let full = self.body(&in_joint, &back.state);
        let (drop_full, full_statements, full) =
            (dropped(&full.used, &arguments), &full.statements, &full.outputs);
        let reduced_rate = local("reduced_rate");
        let implementation = self.implement(
            &quote!(#runtime::Reconstruction<#target>),
            &quote! {
                type Joint = #joint_type;
                fn join(&self, #t: #scalar, #state: &<Self as #dynamics>::State) -> #joint_type {
                    #joint_name {
                        reduced: <Self as #runtime::Reduction<#target>>::reduce(self, #t, #state),
                        group: #group_of_state,
                    }
                }
                #[inline]
                fn reduced_part(#joint: &#joint_type) -> <#target as #dynamics>::State {
                    #joint.reduced
                }
                #[inline]
                fn joint_rate(
                    &self, #t: #scalar, #joint: &#joint_type, #reduced_rate: &<#target as #dynamics>::State
                ) -> #joint_type {
                    #drop_rates #rate_statements
                    #joint_name { reduced: *#reduced_rate, group: #rates }
                }
                fn reconstruct(&self, #t: #scalar, #joint: &#joint_type) -> <Self as #dynamics>::State {
                    #drop_full #full_statements
                    #runtime::State::from_array([#(#full),*])
                }
            },
        );
        quote!(#group_record #joint_struct #implementation)
    }

    /// A name of a struct that hides neither of the two systems, which are named where it is declared, nor their scalar.
    fn name_beside(&self, name: &str) -> Ident {
        let systems = [&self.types.source, &self.types.target].into_iter().cloned().flatten();
        let mut taken: Vec<String> = systems.map(|token| token.to_string()).collect();
        taken.extend(self.context.parameter().map(ToString::to_string));
        let others = ["The", "This", "Its"].map(|before| format!("{before}{name}"));
        let free = others.iter().map(String::as_str).find(|other| !taken.iter().any(|known| known == other));
        let is_free = !taken.iter().any(|known| known == name);
        format_ident!("{}", if is_free { name } else { free.unwrap_or(name) })
    }

    /// The struct of the dropped coordinates.
    fn group(&self, back: &Reconstruction) -> Record {
        let layout = self.context.layout;
        let all = Context::new(layout, &back.dropped, &[]);
        Record {
            name: self.name_beside("Group"),
            doc: "The coordinates that the reduction drops.".into(),
            fields: all.state.fields,
        }
    }

    /// The type of the dropped coordinates; `()` if there are none.
    fn group_type(&self, group: &Record) -> TokenStream {
        if group.len() == 0 { quote!(()) } else { self.context.type_of(group) }
    }

    /// The joint state, and its type.
    fn joint(&self, name: &Ident, group: &Record) -> (TokenStream, TokenStream) {
        let Context { runtime, scalar, .. } = self.context;
        let target = &self.types.target;
        let (impl_generics, generics) =
            (self.context.record_impl_generics(), self.context.parameter().map(|p| quote!(<#p>)));
        let group_type = self.group_type(group);
        let reduced = quote!(<#target as #runtime::Dynamics>::State);
        let (first, second) = (self.target.state.len(), group.len());
        let length = Literal::usize_unsuffixed(first + second);
        let [n, m] = [first, second].map(Literal::usize_unsuffixed);
        let indices = |count: usize| (0..count).map(Literal::usize_unsuffixed).collect::<Vec<_>>();
        let (of_reduced, of_group) = (indices(first), indices(second));
        let (r, g, names) = (local("reduced"), local("group"), group.names());
        let components: Vec<_> = (0..first + second).map(|index| local(&format!("c{index}"))).collect();
        let (front, rest) = components.split_at(first);
        let unused = (first == 0).then(|| quote!(_ = #r;));
        // without dropped coordinates there is no array of them
        let group_array =
            (second > 0).then(|| quote!(let #g: [#scalar; #m] = ::core::convert::From::from(self.group);));
        let group_value = if second > 0 {
            quote!(::core::convert::From::<[#scalar; #m]>::from([#(#rest),*]))
        } else {
            quote!(())
        };
        let tokens = quote! {
            /// The reduced state, and the coordinates that the reduction drops.
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
            pub struct #name #impl_generics {
                /// The reduced state.
                pub reduced: #reduced,
                /// The dropped coordinates.
                pub group: #group_type,
            }
            #[automatically_derived]
            impl #impl_generics #runtime::State for #name #generics {
                type Scalar = #scalar;
                type Dim = #runtime::D<#length>;
                fn to_array(&self) -> [#scalar; #length] {
                    let #r: [#scalar; #n] = #runtime::State::to_array(&self.reduced);
                    #group_array
                    #unused
                    [#(#r[#of_reduced],)* #(#g[#of_group],)*]
                }
                fn from_array([#(#components),*]: [#scalar; #length]) -> Self {
                    Self {
                        reduced: #runtime::State::from_array([#(#front),*]),
                        group: #group_value,
                    }
                }
                fn names() -> [&'static ::core::primitive::str; #length] {
                    let #r: [&'static ::core::primitive::str; #n] = <#reduced as #runtime::State>::names();
                    #unused
                    [#(#r[#of_reduced],)* #(#names),*]
                }
            }
        };
        (tokens, quote!(#name #generics))
    }
}
