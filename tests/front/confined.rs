//! Programs where there is no bubblewrap, on Linux: kept by the kernel itself from what they are not given.

use super::place::{Place, Printed};
use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::os::unix::net::UnixListener;
use std::path::Path;

/// A folder of links to programs, without `bwrap`.
fn bare(place: &Place) {
    let bare = place.path("bare");
    fs::create_dir(&bare).unwrap();
    for name in [
        "sh", "cat", "cp", "ls", "ln", "mv", "rm", "chmod", "chown", "touch", "truncate", "mkdir",
        "kill", "python3",
    ] {
        let at = ["/usr/bin", "/bin"].map(|folder| Path::new(folder).join(name));
        let found = at.iter().find(|program| program.exists());
        symlink(found.unwrap_or_else(|| panic!("{name}")), bare.join(name)).unwrap();
    }
}

/// A node that runs lines of a shell, with more keys.
fn node(line: &str, more: &str) -> String {
    format!(
        "goal = \"x\"\n[node.x]\nstage = \"exec\"\nout = \"document\"\n{more}command = [\"sh\", \"-c\", '''{line}''', \"sh\", \"{{out}}\"]\n"
    )
}

/// Runs a pipeline without bubblewrap; `None` where the kernel cannot keep programs either.
fn run(place: &Place, before: &str, pipeline: &str) -> Option<Printed> {
    place.write("p.toml", pipeline);
    if !place.path("bare").exists() {
        bare(place);
    }
    let exe = env!("CARGO_BIN_EXE_tailor");
    let printed = place.bash(&format!(
        "{before} PATH=$PWD/bare exec {exe} run p.toml x --out out --allow-exec --threads 1"
    ));
    if printed.err.contains("(Landlock: ") || printed.err.contains("(seccomp: ") {
        proof::passed_over(printed.err.lines().next().unwrap_or_default());
        return None;
    }
    assert!(printed.err.contains("Landlock keeps"), "{}", printed.err);
    Some(printed)
}

/// What lines of a shell print, without bubblewrap.
fn prints(place: &Place, line: &str, more: &str) -> Option<String> {
    let line = format!("({line}) > \"$1/printed.txt\" 2>&1; true");
    run(place, "", &node(&line, more))?.code(0);
    Some(fs::read_to_string(place.path("out/x.txt")).unwrap())
}

#[test]
fn without_bubblewrap_a_program_does_its_work() {
    let place = Place::new();
    // Modes and times of what is copied are as they come, and that is no error.
    let line = "cp -p /bin/sh $TMPDIR/a; mkdir $TMPDIR/b; mv $TMPDIR/a $TMPDIR/b; chmod 600 $TMPDIR/b/a; ls $TMPDIR/b; \
        python3 -c 'import subprocess, socket; print(subprocess.check_output([\"ls\", \"b\"])); socket.socketpair()'; \
        echo done > /dev/null; cat < /dev/null";
    let Some(printed) = prints(&place, line, "") else {
        return;
    };
    assert_eq!(printed, "a\nb'a\\n'\n");
}

#[test]
fn without_bubblewrap_a_program_changes_nothing_elsewhere() {
    let place = Place::new();
    let mine = place.path("mine.txt");
    place.write("mine.txt", "mine");
    place.write("mine/inner.txt", "mine, too");
    fs::set_permissions(&mine, PermissionsExt::from_mode(0o640)).unwrap();
    let before = fs::metadata(&mine).unwrap();
    let folder = place.path(".").display().to_string();
    let lines = [
        "echo no > F/mine.txt",
        "echo no > F/new.txt",
        "rm -r F/mine",
        "mv F/mine F/moved",
        "mv F/mine.txt $TMPDIR/",
        "ln F/mine.txt $TMPDIR/linked",
        "chmod 777 F/mine.txt",
        "chown 1:1 F/mine.txt",
        "touch -d 2001-01-01 F/mine.txt",
        "truncate -s 0 F/mine.txt",
        "mkdir F/folder",
        "echo no > /tmp/confined-was-here",
        "echo no > F/cache/format",
        "ln -s F/mine.txt $TMPDIR/link && echo no > $TMPDIR/link",
    ];
    let line = lines.map(|line| line.replace('F', &folder)).join("; ");
    let Some(printed) = prints(&place, &line, "") else {
        return;
    };
    let after = fs::metadata(&mine).unwrap();
    let of = |meta: &fs::Metadata| (meta.mode(), meta.uid(), meta.mtime(), meta.nlink());
    assert_eq!(of(&before), of(&after), "{printed}");
    assert_eq!(fs::read_to_string(&mine).unwrap(), "mine", "{printed}");
    assert!(place.path("mine/inner.txt").exists(), "{printed}");
    for name in ["new.txt", "moved", "folder"] {
        assert!(!place.path(name).exists(), "{name}: {printed}");
    }
    assert!(!Path::new("/tmp/confined-was-here").exists());
    assert!(
        !fs::read_to_string(place.path("cache/format"))
            .unwrap()
            .contains("no")
    );
}

#[test]
fn without_bubblewrap_what_was_not_declared_cannot_be_read() {
    let place = Place::new();
    place.write("secret.txt", "hidden words");
    place.write("declared/read.txt", "declared words");
    let reported = place.path("declared").display().to_string();
    let secret = place.path("secret.txt").display().to_string();
    let line = format!(
        "cat {secret}; ls {}; cat /etc/passwd; ls /; cat {reported}/read.txt; cat <&9",
        place.path(".").display()
    );
    // What the program itself was started with open is nobody's either.
    let before = "exec 9<secret.txt;";
    let line = format!("({line}) > \"$1/printed.txt\" 2>&1; true");
    let Some(ran) = run(
        &place,
        before,
        &node(&line, &format!("reads = [\"{reported}\"]\n")),
    ) else {
        return;
    };
    ran.code(0);
    let printed = fs::read_to_string(place.path("out/x.txt")).unwrap();
    assert!(printed.contains("declared words"), "{printed}");
    for hidden in ["hidden words", "secret.txt\n", "root:", "home\n"] {
        assert!(
            !printed.replace(&format!("{secret}:"), "").contains(hidden),
            "{hidden}: {printed}"
        );
    }
}

/// What the adversary tried on other processes and on sockets: it prints what it got done.
const REACH: &str = r#"
import ctypes, os, signal, socket, sys
libc = ctypes.CDLL(None, use_errno=True)
parent = int(sys.argv[3])
def done(what, call):
    try:
        if call() not in (-1, False): print("DONE", what, flush=True)
    except OSError as e: print(what, e)
done("signal", lambda: os.kill(parent, 0) or True)
done("environ", lambda: open(f"/proc/{parent}/environ").read())
done("root", lambda: open(f"/proc/{parent}/root/etc/passwd").read())
done("memory", lambda: open(f"/proc/{parent}/mem", "rb").read(1))
done("ptrace", lambda: libc.ptrace(16, parent, 0, 0))
done("unshare", lambda: libc.unshare(0x10000000))
done("mount", lambda: libc.mount(b"none", b"/tmp", b"tmpfs", 0, None))
def unix():
    s = socket.socket(socket.AF_UNIX); s.connect(sys.argv[1]); return True
def tcp():
    s = socket.socket(); s.connect(("127.0.0.1", int(sys.argv[2]))); return True
done("unix", unix); done("tcp", tcp)
done("other numbers", lambda: libc.syscall(0x40000000 + 41, 2, 1, 0))
done("uring", lambda: libc.syscall(425, 8, ctypes.create_string_buffer(256)))
done("device", lambda: os.mknod("disk", 0o60600, os.makedev(7, 0)) or True)
done("limits", lambda: libc.prlimit(parent, 7, ctypes.byref((ctypes.c_ulong * 2)(64, 64)), None))
print("END")
"#;

#[test]
fn without_bubblewrap_a_program_reaches_no_process_and_no_socket() {
    let place = Place::new();
    place.write("reach.py", REACH);
    let socket = place.path("socket");
    let _unix = UnixListener::bind(&socket).unwrap();
    let tcp = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = tcp.local_addr().unwrap().port();
    let outside = std::process::id();
    let line = format!("python3 \"$2\" {} {port} {outside}", socket.display());
    let line = format!("({line}) > \"$1/printed.txt\" 2>&1; true");
    let text = node(&line, "files = [\"reach.py\"]\n")
        .replace("\"{out}\"]", "\"{out}\", \"{here}/reach.py\"]");
    let Some(ran) = run(&place, "", &text) else {
        return;
    };
    let ran = ran.code(0);
    let printed = fs::read_to_string(place.path("out/x.txt")).unwrap();
    assert!(printed.ends_with("END\n"), "{printed}");
    // Kernels before 6.12 keep no signals back, and that is reported.
    let signals = ran.err.contains("can send them signals");
    let done: Vec<&str> = printed
        .lines()
        .filter(|line| line.starts_with("DONE"))
        .collect();
    let may: &[&str] = if signals { &["DONE signal"] } else { &[] };
    assert_eq!(done, may, "{printed}");
}

#[test]
fn without_bubblewrap_a_full_sandbox_can_be_required() {
    let place = Place::new();
    place.write("p.toml", node("echo a > $1/a.txt", ""));
    bare(&place);
    let exe = env!("CARGO_BIN_EXE_tailor");
    let line = format!("PATH=$PWD/bare exec {exe} run p.toml --allow-exec --sandbox required");
    let printed = place.bash(&line).code(2).err;
    assert!(
        printed.contains("not installed") && printed.contains("--sandbox required"),
        "{printed}"
    );
}

/// A program that stays, renames where its result goes, and puts a link to a user's folder there.
const SWAPS: &str = "
import sys, json, os, time
print(json.dumps({'ready': True}), flush=True)
done = 'nothing '
for n, line in enumerate(sys.stdin):
    out = json.loads(line)[-2]
    try: open(out + '/note.txt', 'w').write(done)
    except OSError as e: sys.stderr.write(str(e) + '\\n')
    for name in (out, os.path.dirname(out)):
        try: os.rename(name, name + '-2'); os.symlink('VICTIM', name); done = 'swapped '
        except OSError as e: sys.stderr.write(str(e) + '\\n')
    print(json.dumps({'done': True}), flush=True)
";

#[test]
fn without_bubblewrap_a_link_in_place_of_a_folder_empties_nothing() {
    let place = Place::new();
    bare(&place);
    let python = fs::read_link(place.path("bare/python3")).unwrap();
    place.write("victim/inner/mine.txt", "mine");
    let victim = place.path("victim");
    let text = SWAPS.replace("VICTIM", &victim.display().to_string());
    let swaps = place.path("swaps");
    fs::write(&swaps, format!("#!{}{text}", python.display())).unwrap();
    fs::set_permissions(&swaps, PermissionsExt::from_mode(0o755)).unwrap();
    let keeps = |name: &str, n: usize| {
        format!(
            "[node.{name}]\nstage = \"exec\"\nout = \"document\"\nkeep = true\nwith = {{ n = {n} }}\n\
             command = [\"{}\", \"{{out}}\", \"{{with.n}}\"]\n",
            swaps.display()
        )
    };
    let text = format!(
        "goal = \"x\"\n{}{}{}[node.x]\nstage = \"exec\"\nout = \"document\"\nfrom = {{ a = \"a\", b = \"b\", c = \"c\" }}\n\
         command = [\"sh\", \"-c\", \"cat $2 $3 $4 > $1/a.txt\", \"sh\", \"{{out}}\", \"{{from.a}}\", \"{{from.b}}\", \"{{from.c}}\"]\n",
        keeps("a", 1),
        keeps("b", 2),
        keeps("c", 3)
    );
    let Some(ran) = run(&place, "", &text) else {
        return;
    };
    let printed = fs::read_to_string(place.path("out/x.txt")).unwrap();
    assert!(printed.contains("swapped"), "{printed}{}", ran.err);
    let mine = fs::read_to_string(victim.join("inner/mine.txt"));
    assert_eq!(mine.unwrap(), "mine", "{}", ran.err);
    assert!(!victim.join("note.txt").exists());
}
