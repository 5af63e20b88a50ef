//! Panics of a subject, caught without a word on the terminal.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// Whether a panic of this thread is ours to report.
    static QUIET: Cell<bool> = const { Cell::new(false) };
    /// What the last of them said.
    static SAID: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Puts a hook before the one that is there, once for the whole program: it keeps to itself what the threads say that
/// ask for it, and hands on everything else. A hook that is changed for each call would be changed for other threads as
/// well.
fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let before = take_hook();
        set_hook(Box::new(move |info| {
            if QUIET.get() {
                let text = info.to_string();
                // "panicked at src/lib.rs:3:5:" and the message stand on two lines.
                let text = text.split('\n').map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>();
                SAID.set(text.join(" "));
            } else {
                before(info);
            }
        }));
    });
}

/// What `f` returns, or what it said when it panicked.
///
/// Built with `panic = "abort"` nothing can be caught, and the program ends.
pub(crate) fn catch<T>(f: impl FnOnce() -> T) -> Result<T, String> {
    listen();
    SAID.set(String::new());
    let outer = QUIET.replace(true);
    // What the closure leaves behind half done is dropped by the callers.
    let result = catch_unwind(AssertUnwindSafe(f));
    QUIET.set(outer);
    result.map_err(|payload| {
        let said = SAID.take();
        if !said.is_empty() {
            return said;
        }
        // Another hook took the place of ours.
        let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
        text.map_or_else(|| "panicked".to_owned(), |text| format!("panicked: {text}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_told_with_its_place() {
        assert_eq!(catch(|| 3), Ok(3));
        let said = catch(|| assert!(std::hint::black_box(1) > 1, "one is {}", 1)).unwrap_err();
        assert!(said.starts_with("panicked at ") && said.contains("quiet.rs") && said.ends_with("one is 1"), "{said}");
        assert!(!QUIET.get());
    }
}
