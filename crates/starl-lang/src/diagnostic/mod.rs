//! What a person is told about a program: a code, a place, a message and perhaps a mend.
