"""The image: a Debian base, made from its mirror, and the result of deploy/Dockerfile on it.

No image registry is used: `debian:bookworm-slim` is bootstrapped here, as slim as the official one.
"""
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

import engine

BASE = "docker.io/library/debian:bookworm-slim"
NAME = "docker.io/library/lockstep:latest"
# Directories that the slim image leaves out.
LEFT_OUT = ("./usr/share/doc/*", "./usr/share/man/*", "./usr/share/locale/*", "./usr/share/info/*",
            "./var/cache/apt/*.bin", "./var/cache/apt/archives/*.deb", "./var/lib/apt/lists/*")


def ask(*words, **how):
    return subprocess.run(words, capture_output=True, text=True, **how)


def last_line(text):
    return (text.strip().splitlines() or ["no reason given"])[-1]


def sources():
    """The Debian 12 source of this host's apt, as (mirror, suite): with it the compiler cache fits the image too."""
    output = ask("apt-get", "indextargets", "--format", "$(SITE) $(RELEASE)", "Created-By: Packages", "Component: main").stdout
    found = dict.fromkeys(tuple(line.split()) for line in output.splitlines())
    return [(site, suite) for site, suite in found if suite.startswith("bookworm")]


def mirror():
    """The Debian mirror of this host's apt; empty if there is none."""
    return next((site for site, suite in sources() if suite == "bookworm"), "")


def apt_settings():
    return [line for line in ask("apt-config", "dump").stdout.splitlines() if line.startswith("Acquire::Check")]


def proxy():
    """The proxy of this host's apt, in the variables of other programs."""
    found = shlex.split(ask("apt-config", "shell", "PROXY", "Acquire::http::Proxy").stdout.strip().partition("=")[2])
    return {"http_proxy": found[0]} if found else {}


def why_no_base(podman, work):
    """Makes the Debian base of the image. Returns the error; nothing on success."""
    if podman.ask("image", "exists", BASE)[0] != 0:
        reason = why_not_bootstrapped(podman, work)
        if reason:
            return reason
    code, output = podman.ask("run", "--rm", "--network", "none", BASE, "true")
    return f"no container can be run: {last_line(output)}" if code else ""


def why_not_bootstrapped(podman, work):
    environment = os.environ | proxy()
    release = f"{mirror()}/dists/bookworm/InRelease"
    if ask("wget", "-q", "-T", "20", "-t", "2", "-O", "/dev/null", release, env=environment).returncode != 0:
        return f"no network to the Debian mirror: {release} cannot be read"
    with tempfile.TemporaryDirectory(dir=work) as root:
        # In its own namespaces: its mounts end with it, and cannot block the removal of the directory.
        made = ask(*engine.NAMESPACES, "debootstrap", "--variant=minbase", "--include=ca-certificates", "bookworm", root,
                   mirror(), env=environment)
        if made.returncode != 0:
            return f"no Debian can be bootstrapped: {last_line(made.stdout + made.stderr)}"
        import_base(podman, pathlib.Path(root))
    return ""


def import_base(podman, root):
    # As in the official image: files in an image need not survive a power cut.
    (root / "etc/dpkg/dpkg.cfg.d/no-sync").write_text("force-unsafe-io\n")
    (root / "etc/apt/sources.list").write_text("".join(f"deb {site} {suite} main\n" for site, suite in sources()))
    (root / "etc/apt/apt.conf.d/as-the-host").write_text("\n".join(apt_settings()) + "\n")
    with subprocess.Popen(["tar", "-C", str(root), *(f"--exclude={path}" for path in LEFT_OUT), "-c", "."],
                          stdout=subprocess.PIPE) as tar:
        podman.run("import", "-", BASE, stdin=tar.stdout, check=True, capture_output=True)


def build(podman, root, work):
    """Builds as a user does, but with this host's caches. Returns the exit code."""
    ran = podman.run("build", "--network", "host", "--pull=never", *compiler_cache(work), *npm_cache(),
                     "--tag", NAME, "--file", str(root / "deploy" / "Dockerfile"), str(root), extra=proxy(),
                     stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    (work / "build.log").write_text(ran.stdout)
    if ran.returncode != 0:
        print(f"the image cannot be built:\n{ran.stdout[-4000:]}", file=sys.stderr)
    return int(ran.returncode != 0)


def compiler_cache(work):
    """This host's compiler cache: the same compiler produces the same output in the image."""
    setting = lambda key: ask("ccache", "--get-config", key).stdout.strip()
    directory = pathlib.Path(setting("cache_dir") or "/none")
    if not directory.is_dir():
        return []
    settings = "".join(f"{key} = {setting(key)}\n" for key in ("hash_dir", "sloppiness", "max_size"))
    (work / "ccache.conf").write_text("cache_dir = /ccache\n" + settings)
    language = [f"{name}={os.environ[name]}" for name in ("LANG", "LC_ALL") if name in os.environ]
    arguments = [word for argument in ["CCACHE_CONFIGPATH=/ccache.conf", *language] for word in ("--build-arg", argument)]
    return ["--volume", f"{directory}:/ccache", "--volume", f"{work / 'ccache.conf'}:/ccache.conf:ro", *arguments]


def npm_cache():
    """Uses this host's package cache."""
    cache = pathlib.Path(ask("npm", "config", "get", "cache").stdout.strip() or "/none")
    return ["--volume", f"{cache}:/root/.npm"] if cache.is_dir() else []


def megabytes(podman, name):
    return round(json.loads(podman.ask("image", "inspect", name)[1])[0]["Size"] / 1e6)


def sizes(podman):
    return {"image_mb": megabytes(podman, NAME), "debian_mb": megabytes(podman, BASE)}


def in_words(podman):
    found = sizes(podman)
    return f"an image of {found['image_mb']} MB, {found['debian_mb']} MB of them Debian"
