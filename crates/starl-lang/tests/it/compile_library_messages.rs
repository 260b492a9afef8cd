//! On the network, a library's message has the library's name before its own, both for the sender and for the handler.

use starl_lang::check::check;
use starl_lang::compile::compile;
use starl_lang::machine::{assemble, disassemble};

const TALK: &str = "library talk\n\nmessage Hello(to: RobotId)\n";
const PROGRAM: &str = "program Greets\n\nimport talk\n\nmessage Hello(number: Int)\n\nradio = Broadcast()\n\ngreet()\n    eff radio.broadcast(talk.Hello(me)); radio.broadcast(Hello(3))\n\non talk.Hello(from, to)\n    log(\"{} {}\", from, to)\n\non Hello(_, number)\n    log(\"{}\", number)\n";

#[test]
fn two_messages_of_one_name_are_distinguished() {
    let libraries = |name: &str| (name == "talk").then(|| TALK.to_string());
    let checked = check(PROGRAM, &libraries);
    let bytecode = compile(&checked).expect("robots have all that it needs");
    let handled: Vec<&str> = (bytecode.handlers.iter())
        .map(|handler| handler.event.as_str())
        .collect();
    assert_eq!(handled, ["talk.Hello", "Hello"]);
    let imports = bytecode.imports.iter();
    let sent = imports.filter(|import| import.name == "Broadcast.broadcast");
    let sent: Vec<&str> = sent
        .flat_map(|import| &import.labels)
        .map(String::as_str)
        .collect();
    assert_eq!(sent, ["talk.Hello", "Hello"]);
    let written = disassemble(&bytecode);
    assert_eq!(assemble(&written), Ok(bytecode));
}
