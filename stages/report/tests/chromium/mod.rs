//! A headless Chromium driven over its debugging pipe (DevTools protocol).

mod axe;

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// How Chromium is run: to draw in software and to keep to itself.
const FLAGS: &str = "--headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader \
     --use-angle=swiftshader --disable-quic --no-first-run --disable-background-networking \
     --disable-component-update --disable-sync --hide-scrollbars --remote-debugging-pipe";

/// One page in a browser of its own.
pub(crate) struct Tab {
    child: Child,
    to: ChildStdin,
    from: Receiver<Value>,
    session: Option<String>,
    sent: u64,
    /// What the browser reported on its own, such as requests and errors.
    pub(crate) events: Vec<Value>,
    _folder: tempfile::TempDir,
}

impl Tab {
    /// The page in a window of this size, light or dark.
    pub(crate) fn open(page: &str, size: [u32; 2], phone: bool, dark: bool) -> Tab {
        let mut tab = Tab::empty(size, phone, dark);
        let file = tab._folder.path().join("report.html");
        std::fs::write(&file, page).unwrap();
        tab.go(&format!("file://{}", file.display()));
        tab.until("Number(document.getElementById('view').dataset.drawn) > 0");
        tab
    }

    /// Goes to an address, and waits until the page is there.
    pub(crate) fn go(&mut self, url: &str) {
        self.ask("Page.navigate", json!({ "url": url }));
        self.until("document.readyState === 'complete'");
    }

    /// Chooses files in a field, as a hand does it.
    pub(crate) fn choose(&mut self, selector: &str, files: &[std::path::PathBuf]) {
        let document = self.ask("DOM.getDocument", json!({}));
        let root = &document["root"]["nodeId"];
        let found = self.ask(
            "DOM.querySelector",
            json!({ "nodeId": root, "selector": selector }),
        );
        let params = json!({ "nodeId": found["nodeId"], "files": files });
        self.ask("DOM.setFileInputFiles", params);
    }

    /// A browser with nothing in it, in a window of this size, light or dark.
    pub(crate) fn empty(size: [u32; 2], phone: bool, dark: bool) -> Tab {
        let Some(program) = option_env!("CHROMIUM") else {
            panic!("no Chromium is installed (apt-get install chromium)")
        };
        let folder = tempfile::tempdir().unwrap();
        let profile = folder.path().join("profile");
        let script = format!(
            "exec {program} {FLAGS} --user-data-dir={} 3<&0 4>&1 >/dev/null 2>&1",
            profile.display()
        );
        let mut child = Command::new("sh")
            .args(["-c", &script])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (sender, from) = channel();
        let mut pipe = BufReader::new(child.stdout.take().unwrap());
        std::thread::spawn(move || {
            let mut message = Vec::new();
            while pipe.read_until(0, &mut message).is_ok_and(|n| n > 0) {
                message.pop();
                let value = serde_json::from_slice(&message).unwrap();
                message.clear();
                if sender.send(value).is_err() {
                    break;
                }
            }
        });
        let mut tab = Tab {
            to: child.stdin.take().unwrap(),
            child,
            from,
            session: None,
            sent: 0,
            events: vec![],
            _folder: folder,
        };
        let target = tab.ask("Target.createTarget", json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        let attached = tab.ask("Target.attachToTarget", attach);
        tab.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Network", "Log"] {
            tab.ask(&format!("{domain}.enable"), json!({}));
        }
        tab.emulate(size, phone, dark);
        tab
    }

    pub(crate) fn emulate(&mut self, [width, height]: [u32; 2], phone: bool, dark: bool) {
        let metrics =
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": phone });
        self.ask("Emulation.setDeviceMetricsOverride", metrics);
        let scheme = if dark { "dark" } else { "light" };
        let media = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        self.ask("Emulation.setEmulatedMedia", media);
    }

    /// Another window around the page: its size, whether it is a phone's, light or dark.
    pub(crate) fn window(&mut self, size: [u32; 2], phone: bool, dark: bool) {
        let draws = self.draws();
        self.emulate(size, phone, dark);
        self.drawn_since(draws);
    }

    /// Sends a command and waits for its answer.
    pub(crate) fn ask(&mut self, method: &str, params: Value) -> Value {
        let answer = self.answer(method, params);
        assert!(answer["error"].is_null(), "{method}: {answer}");
        answer["result"].clone()
    }

    fn answer(&mut self, method: &str, params: Value) -> Value {
        self.sent += 1;
        let mut message = json!({ "id": self.sent, "method": method, "params": params });
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let mut bytes = serde_json::to_vec(&message).unwrap();
        bytes.push(0);
        self.to.write_all(&bytes).unwrap();
        loop {
            let answer = self.from.recv_timeout(Duration::from_secs(120));
            let answer = answer.unwrap_or_else(|_| panic!("no answer to {method}"));
            if answer["id"] == self.sent {
                return answer;
            }
            self.events.push(answer);
        }
    }

    /// The value of an expression, after what it waits for.
    pub(crate) fn value(&mut self, expression: &str) -> Value {
        let params =
            json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let answer = self.ask("Runtime.evaluate", params);
        assert!(
            answer["exceptionDetails"].is_null(),
            "{expression}: {answer}"
        );
        answer["result"]["value"].clone()
    }

    /// Waits until an expression holds.
    #[track_caller]
    pub(crate) fn until(&mut self, expression: &str) {
        self.until_within(60, expression);
    }

    /// As `until`, for so many seconds at least; the page may come anew meanwhile.
    #[track_caller]
    pub(crate) fn until_within(&mut self, seconds: u64, expression: &str) {
        let params =
            json!({ "expression": format!("Boolean({expression})"), "returnByValue": true });
        let mut answer = Value::Null;
        for _ in 0..20 * seconds {
            answer = self.answer("Runtime.evaluate", params.clone());
            if answer["result"]["result"]["value"] == true {
                return;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("never: {expression}: {answer}");
    }

    /// Waits until what was asked for is drawn, or the page went away.
    pub(crate) fn drawn(&mut self) {
        let frames =
            "new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => r(1))))";
        let params = json!({ "expression": frames, "awaitPromise": true });
        self.answer("Runtime.evaluate", params);
    }

    /// How often the 3D view was drawn.
    fn draws(&mut self) -> u64 {
        let draws = self.value("Number(document.getElementById('view').dataset.drawn)");
        draws.as_u64().unwrap()
    }

    /// Waits until the 3D view was drawn anew, and to its end: wheel and fingers come late.
    #[track_caller]
    fn drawn_since(&mut self, draws: u64) {
        self.until(&format!(
            "Number(document.getElementById('view').dataset.drawn) > {draws}"
        ));
        self.drawn();
    }

    fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], buttons: u32) {
        let button = if kind == "mouseMoved" { "none" } else { "left" };
        let params = json!({ "type": kind, "x": x, "y": y, "button": button, "buttons": buttons, "clickCount": 1 });
        self.ask("Input.dispatchMouseEvent", params);
    }

    /// The middle of what a selector finds, scrolled into view.
    fn middle(&mut self, selector: &str) -> [f64; 2] {
        let at = self.value(&format!(
            "(() => {{ const e = document.querySelector({selector:?}); e.scrollIntoView({{ block: 'center' }}); \
             const r = e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; }})()"
        ));
        // A pointer meets what the last frame shows, so the frame after the scrolling must be there.
        self.drawn();
        [at[0].as_f64().unwrap(), at[1].as_f64().unwrap()]
    }

    /// A click as a hand does it: on whatever is there, once the page is whole.
    #[track_caller]
    pub(crate) fn click(&mut self, selector: &str) {
        self.until("document.readyState === 'complete'");
        let at = self.middle(selector);
        self.mouse("mousePressed", at, 1);
        self.mouse("mouseReleased", at, 0);
        self.drawn();
    }

    /// Drags from the middle.
    pub(crate) fn drag(&mut self, selector: &str, [dx, dy]: [f64; 2]) {
        let draws = self.draws();
        let [x, y] = self.middle(selector);
        self.mouse("mousePressed", [x, y], 1);
        self.mouse("mouseMoved", [x + dx / 2.0, y + dy / 2.0], 1);
        self.mouse("mouseMoved", [x + dx, y + dy], 1);
        self.mouse("mouseReleased", [x + dx, y + dy], 0);
        self.drawn_since(draws);
    }

    /// Turns the wheel over the middle.
    pub(crate) fn wheel(&mut self, selector: &str, by: f64) {
        let draws = self.draws();
        let [x, y] = self.middle(selector);
        let params = json!({ "type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": by });
        self.ask("Input.dispatchMouseEvent", params);
        self.drawn_since(draws);
    }

    /// Two fingers on the middle that part from `from` to `to` pixels.
    pub(crate) fn pinch(&mut self, selector: &str, from: f64, to: f64) {
        let draws = self.draws();
        let [x, y] = self.middle(selector);
        let fingers = |d: f64| json!([{ "x": x - d / 2.0, "y": y, "id": 0 }, { "x": x + d / 2.0, "y": y, "id": 1 }]);
        for (kind, points) in [
            ("touchStart", fingers(from)),
            ("touchMove", fingers((from + to) / 2.0)),
            ("touchMove", fingers(to)),
            ("touchEnd", json!([])),
        ] {
            let params = json!({ "type": kind, "touchPoints": points });
            self.ask("Input.dispatchTouchEvent", params);
        }
        self.drawn_since(draws);
    }

    /// Presses a key.
    pub(crate) fn key(&mut self, key: &str) {
        for kind in ["keyDown", "keyUp"] {
            self.ask(
                "Input.dispatchKeyEvent",
                json!({ "type": kind, "key": key }),
            );
        }
        self.drawn();
    }

    /// What the window shows, as a PNG file in base 64.
    pub(crate) fn screenshot(&mut self) -> String {
        let shot = self.ask("Page.captureScreenshot", json!({ "format": "png" }));
        shot["data"].as_str().unwrap().to_owned()
    }
}

impl Drop for Tab {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
