//! Chromium without a screen, by its debugging protocol over pipes: real events of mouse and keyboard, what the page really
//! shows, and a log of every request.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use base64::Engine as _;
use serde_json::{Value, json};

/// A browser with one page.
pub struct Browser {
    process: Child,
    orders: ChildStdin,
    answers: BufReader<ChildStdout>,
    session: Option<String>,
    serial: u64,
    log: PathBuf,
    _profile: tempfile::TempDir,
}

/// Names under which it is installed.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

const WINDOW: [u32; 2] = [1200, 900];

impl Browser {
    /// Starts a browser with no page.
    pub fn start() -> Self {
        let runs = |name: &&str| Command::new(name).arg("--version").output().is_ok_and(|run| run.status.success());
        let name = NAMES.into_iter().find(|name| runs(name));
        let name = name.expect("this test needs Chromium: `sh setup.sh --tests` installs it");
        let profile = tempfile::tempdir().unwrap();
        let log = profile.path().join("requests.json");
        // The protocol is spoken on the third and fourth file that is open.
        let mut command = Command::new("sh");
        command.args(["-c", "exec \"$@\" 3<&0 4>&1 </dev/null >/dev/null", "sh", name]);
        command.args(["--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--disable-gpu", "--no-first-run"]);
        command.args(["--disable-background-networking", "--disable-component-update", "--disable-sync"]);
        command.args(["--disable-dev-shm-usage", "--force-device-scale-factor=1", "--hide-scrollbars"]);
        command.arg("--host-resolver-rules=MAP * ~NOTFOUND");
        command.arg(format!("--window-size={},{}", WINDOW[0], WINDOW[1]));
        command.arg(format!("--user-data-dir={}", profile.path().display()));
        command.arg(format!("--log-net-log={}", log.display()));
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut process = command.spawn().unwrap();
        let (orders, answers) = (process.stdin.take().unwrap(), BufReader::new(process.stdout.take().unwrap()));
        Self { process, orders, answers, session: None, serial: 0, log, _profile: profile }
    }

    /// Shows a page, and waits until it is there.
    pub fn open(&mut self, address: &str) {
        self.session = None;
        let target = self.order("Target.createTarget", json!({"url": "about:blank"}))["targetId"].clone();
        let attached = self.order("Target.attachToTarget", json!({"targetId": target, "flatten": true}));
        self.session = attached["sessionId"].as_str().map(str::to_owned);
        let size = json!({"width": WINDOW[0], "height": WINDOW[1], "deviceScaleFactor": 1, "mobile": false});
        self.order("Emulation.setDeviceMetricsOverride", size);
        self.order("Page.navigate", json!({"url": address}));
        self.wait(&format!(
            "document.readyState === 'complete' && location.href !== 'about:blank' || {address:?} === 'about:blank'"
        ));
    }

    /// What an expression is on the page.
    pub fn read(&mut self, expression: &str) -> Value {
        let asked = json!({"expression": expression, "returnByValue": true, "awaitPromise": true});
        let answer = self.order("Runtime.evaluate", asked);
        assert!(answer.get("exceptionDetails").is_none(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    pub fn text(&mut self, expression: &str) -> String {
        self.read(expression).as_str().unwrap_or_else(|| panic!("{expression} is no text")).to_owned()
    }

    pub fn number(&mut self, expression: &str) -> f64 {
        self.read(expression).as_f64().unwrap_or_else(|| panic!("{expression} is no number"))
    }

    /// Waits until an expression is true: at most 20 seconds.
    pub fn wait(&mut self, expression: &str) {
        for _ in 0..400 {
            if self.read(expression) == Value::Bool(true) {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(50));
        }
        panic!("waited in vain for {expression}");
    }

    /// The middle of an element, which is scrolled to.
    pub fn middle(&mut self, element: &str) -> [f64; 2] {
        let place = format!(
            "(() => {{ const e = {element}; e.scrollIntoView({{block: 'center', behavior: 'instant'}}); \
             const r = e.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; }})()"
        );
        let place = self.read(&place);
        [0, 1].map(|i| place[i].as_f64().expect("an element that is shown"))
    }

    /// One event of the mouse: `mousePressed`, `mouseMoved`, `mouseReleased`.
    pub fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], shift: bool) {
        let held = u8::from(kind != "mouseReleased");
        let event = json!({"type": kind, "x": x, "y": y, "button": "left", "buttons": held, "clickCount": 1,
            "modifiers": if shift { 8 } else { 0 }});
        self.order("Input.dispatchMouseEvent", event);
    }

    pub fn click(&mut self, element: &str, shift: bool) {
        let at = self.middle(element);
        self.mouse("mousePressed", at, shift);
        self.mouse("mouseReleased", at, shift);
    }

    /// Turns the wheel; towards the user is positive.
    pub fn wheel(&mut self, [x, y]: [f64; 2], by: f64) {
        let event = json!({"type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": by});
        self.order("Input.dispatchMouseEvent", event);
    }

    /// Presses and lets go a key that writes a letter.
    pub fn key(&mut self, key: &str) {
        let event = |kind: &str| json!({"type": kind, "key": key, "text": key});
        self.order("Input.dispatchKeyEvent", event("keyDown"));
        self.order("Input.dispatchKeyEvent", json!({"type": "keyUp", "key": key}));
    }

    /// What is shown, as PNG.
    pub fn screenshot(&mut self) -> Vec<u8> {
        let answer = self.order("Page.captureScreenshot", json!({"format": "png"}));
        base64::engine::general_purpose::STANDARD.decode(answer["data"].as_str().unwrap()).unwrap()
    }

    /// Ends it. Every address that a page asked for; the browser asks for some on its own behalf, and gets none.
    pub fn requests(mut self) -> Vec<String> {
        self.session = None;
        self.order("Browser.close", json!({}));
        self.process.wait().unwrap();
        let log: Value = serde_json::from_slice(&fs::read(&self.log).unwrap()).expect("a whole log");
        let events = log["events"].as_array().unwrap();
        let started = events.iter().map(|event| &event["params"]).filter(|of| of["initiator"].is_string());
        let by_page = started.filter(|of| of["initiator"] != "not an origin");
        by_page.filter_map(|of| of["url"].as_str()).map(str::to_owned).collect()
    }

    fn order(&mut self, method: &str, parameters: Value) -> Value {
        self.serial += 1;
        let mut order = json!({"id": self.serial, "method": method, "params": parameters});
        if let Some(session) = &self.session {
            order["sessionId"] = session.as_str().into();
        }
        self.orders.write_all(format!("{order}\0").as_bytes()).unwrap();
        loop {
            let mut answer = Vec::new();
            self.answers.read_until(0, &mut answer).unwrap();
            assert_eq!(answer.pop(), Some(0), "the browser ended at {method}");
            let answer: Value = serde_json::from_slice(&answer).unwrap();
            if answer["id"] == self.serial {
                assert!(answer.get("error").is_none(), "{method}: {answer}");
                return answer["result"].clone();
            }
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The address of a file.
pub fn address(path: &Path) -> String {
    format!("file://{}", path.canonicalize().unwrap().display())
}
