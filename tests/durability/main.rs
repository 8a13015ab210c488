//! What a crash, a stop or a pause may not change: black-box tests of a server that is killed while it works.

mod kill;
mod server;
mod stop;
