//! The program: an exit code.

fn main() -> std::process::ExitCode {
    tailor::main()
}
