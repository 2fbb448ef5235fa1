#!/bin/sh
# Makes sure that Lucerna can build and draw here: a Rust toolchain, a C linker, a C++ compiler, and a graphics driver that
# wgpu can use.
#
#   sh setup.sh           # to build and draw
#   sh setup.sh --tests   # to run the tests as well: on Linux, also an X server without a screen (Xvfb), for the window
#   sh setup.sh --release-mesa   # with the release's own Mesa, also where its backports have a newer one
#
# Where a driver is there already, and on macOS (Metal) and Windows (DirectX 12), nothing is installed. On Debian and
# Ubuntu without one, the Vulkan loader and Mesa's drivers are, which draw on the CPU if need be; and g++ without a compiler.
# On a Debian whose own Mesa is older than 25, and where nothing but the CPU draws, root gets Mesa from the release's
# backports: it draws half as fast again there. Running it again is quick and changes nothing. Exits with 0 if all is there,
# else with 1, and says what to do.
set -eu

say() { printf 'setup: %s\n' "$*"; }
complain() { printf 'setup: %s\n' "$*" >&2; }
have() { command -v "$1" >/dev/null 2>&1; }

# Whether the dynamic linker finds a library: by an absolute path, or by its name.
library() {
    case $1 in
        /*) [ -e "$1" ]; return ;;
    esac
    for ldconfig in ldconfig /sbin/ldconfig /usr/sbin/ldconfig; do
        if have "$ldconfig" && "$ldconfig" -p 2>/dev/null | grep -qF "$1"; then return 0; fi
    done
    old_ifs=$IFS; IFS=:
    for folder in ${LD_LIBRARY_PATH:-} /run/opengl-driver/lib /usr/lib /usr/lib64 /usr/local/lib /lib /lib64 \
        "/usr/lib/$(uname -m)-linux-gnu"; do
        if [ -n "$folder" ] && [ -e "$folder/$1" ]; then IFS=$old_ifs; return 0; fi
    done
    IFS=$old_ifs
    return 1
}

# The manifests of Vulkan drivers, one a line, where the loader looks for them.
manifests() {
    chosen=${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}
    if [ -n "$chosen" ]; then
        printf '%s\n' "$chosen" | tr ':' '\n'
        return
    fi
    home=${HOME:-/root}
    printf '%s\n' "${XDG_CONFIG_HOME:-$home/.config}:${XDG_CONFIG_DIRS:-/etc/xdg}:/usr/local/etc:/etc" \
        "${XDG_DATA_HOME:-$home/.local/share}:${XDG_DATA_DIRS:-/usr/local/share:/usr/share}:/usr/share:/run/opengl-driver/share" |
        tr ':' '\n' | while IFS= read -r folder; do
        for manifest in "$folder"/vulkan/icd.d/*.json; do
            if [ -e "$manifest" ]; then printf '%s\n' "$manifest"; fi
        done
    done
}

# Prints the names of the drivers that can be loaded.
drivers() {
    manifests | while IFS= read -r manifest; do
        [ -r "$manifest" ] || continue
        path=$(sed -n 's/.*"library_path"[^"]*"\([^"]*\)".*/\1/p' "$manifest" | head -n 1)
        case $path in
            '') continue ;;
            ./* | ../*) path=$(dirname "$manifest")/$path ;;
        esac
        # NVIDIA's manifest is often there without a card, in containers above all.
        case $path in
            *nvidia*) if [ ! -e /dev/nvidiactl ] && [ ! -e /dev/dxg ]; then continue; fi ;;
        esac
        if library "$path"; then
            basename "$manifest" .json
        fi
    done | sort -u | tr '\n' ' '
}

install_with_apt() {
    as_root=
    if [ "$(id -u)" -ne 0 ]; then
        if ! have sudo; then
            complain "something is missing. As root, run: apt-get install $*"
            return 1
        fi
        as_root=sudo
    fi
    say "installing $*"
    # A stale or unreachable list need not stop an install that a cache or a mirror can serve.
    $as_root apt-get update -qq || complain "apt-get update failed; going on with the package lists that are there"
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

# Mesa of this version draws on the CPU half as fast again as those before.
fast_mesa=25
backports_file=/etc/apt/sources.list.d/lucerna-backports.sources

# The number before the first dot of a Debian version; 0 for none.
major() {
    version=${1#*:}
    version=${version%%[!0-9]*}
    printf '%s' "${version:-0}"
}

# Whether there is nothing but the CPU to draw with.
draws_on_cpu() {
    for device in /dev/dri/renderD* /dev/nvidiactl /dev/dxg; do
        if [ -e "$device" ]; then return 1; fi
    done
}

# The code name of a Debian release; nothing on other systems.
debian_release() {
    [ -r /etc/os-release ] || return 0
    # shellcheck disable=SC1091
    (. /etc/os-release && [ "${ID:-}" = debian ] && printf '%s' "${VERSION_CODENAME:-}") || true
}

# Mesa's version in the release's backports, from the package lists that are there; nothing if they don't have it.
mesa_in_backports() {
    apt-cache madison mesa-vulkan-drivers 2>/dev/null |
        awk -F' *[|] *' -v suite=" $1-backports/main" 'index($3, suite) { print $2; exit }'
}

# Where apt has the release from.
release_uri() {
    apt-get indextargets --format '$(REPO_URI)|$(RELEASE)|$(CODENAME)|$(COMPONENT)' 'Created-By: Packages' 2>/dev/null |
        awk -F'|' -v release="$1" '$3 == release && $2 !~ /[-\/]/ && $4 == "main" { print $1; exit }'
}

# The key that a source of apt names for a URI; nothing if it names none.
key_of() {
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
        [ -r "$file" ] || continue
        case $file in
            *.sources) stanza= ;;
            *) stanza='\n' ;;
        esac
        awk -v uri="${1%/}" -v RS="$stanza" '
            { text = " " $0 " "; gsub(/[ \t\n]+/, " ", text) }
            text ~ /^ *#/ && RS != "" { next }
            !index(text, " " uri " ") && !index(text, " " uri "/ ") { next }
            match(tolower(text), /(signed-by=|signed-by: )[^] ]+/) {
                key = substr(text, RSTART, RLENGTH)
                sub(/^[^=:]*(=|: )/, "", key)
                if (key !~ /^-/) { print key; exit }
            }' "$file"
    done | head -n 1
}

# Has apt know the backports of a release, by a file of their own, until they turn out not to have a newer Mesa.
add_backports() {
    [ -d "${backports_file%/*}" ] && [ ! -e "$backports_file" ] || return 1
    uri=$(release_uri "$1")
    [ -n "$uri" ] || return 1
    key=$(key_of "$uri")
    printf '%s\n' "Types: deb" "URIs: $uri" "Suites: $1-backports" "Components: main" >"$backports_file" || return 1
    if [ -n "$key" ]; then printf '%s\n' "Signed-By: $key" >>"$backports_file"; fi
    apt-get update -qq >/dev/null 2>&1 || true
    if [ "$(major "$(mesa_in_backports "$1")")" -ge "$fast_mesa" ]; then return 0; fi
    rm -f "$backports_file"
    apt-get update -qq >/dev/null 2>&1 || true
    return 1
}

# Installs Mesa from the backports where that is worth it, and says so in a line. Fails where there is nothing to be had.
newer_mesa() {
    release=$(debian_release)
    if [ -z "$release" ] || ! have apt-get || ! have apt-cache || ! draws_on_cpu; then return 1; fi
    if [ "$(id -u)" -eq 0 ]; then apt-get update -qq >/dev/null 2>&1 || true; fi
    own=$(apt-cache policy mesa-vulkan-drivers 2>/dev/null | awk '$1 == "Candidate:" { print $2 }')
    if [ -z "$own" ] || [ "$own" = "(none)" ] || [ "$(major "$own")" -ge "$fast_mesa" ]; then return 1; fi
    if [ "$release_mesa" = yes ]; then
        say "Mesa $own of the release is kept (--release-mesa)"
        return 1
    fi
    if [ "$(id -u)" -ne 0 ]; then
        say "Mesa $own draws on the CPU a third as fast as $fast_mesa.0: where the release's backports have that, sh setup.sh as root installs it"
        return 1
    fi
    from=
    if [ "$(major "$(mesa_in_backports "$release")")" -lt "$fast_mesa" ]; then
        add_backports "$release" || return 1
        from="; apt's entry for them is $backports_file"
    fi
    version=$(mesa_in_backports "$release")
    # What is installed stays: if that can't be, so does the older Mesa.
    if env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-remove --no-install-recommends \
        -t "$release-backports" libvulkan1 mesa-vulkan-drivers >/dev/null 2>&1; then
        say "Mesa $version from $release-backports, in place of $own (--release-mesa keeps that)$from"
        return 0
    fi
    complain "Mesa $version of $release-backports could not be installed: going on with $own"
    if [ -n "$from" ]; then
        rm -f "$backports_file"
        apt-get update -qq >/dev/null 2>&1 || true
    fi
    return 1
}

# The version of Mesa's drivers that dpkg has installed; nothing without.
mesa_installed() {
    have dpkg-query || return 0
    dpkg-query -W -f '${db:Status-Status} ${Version}' mesa-vulkan-drivers 2>/dev/null | sed -n 's/^installed //p'
}

check_driver() {
    case $(uname -s) in
        Darwin) say "graphics: Metal is part of macOS"; return 0 ;;
        MINGW* | MSYS* | CYGWIN*) say "graphics: DirectX 12 is part of Windows"; return 0 ;;
    esac
    found=$(drivers)
    if [ -n "$found" ] && library libvulkan.so.1; then
        # A Mesa of the release that is there is made newer: nothing else of the drivers is touched.
        installed=$(mesa_installed)
        if [ -n "$installed" ] && [ "$(major "$installed")" -lt "$fast_mesa" ] && newer_mesa; then found=$(drivers); fi
        say "Vulkan drivers: $found"
        return 0
    fi
    missing=
    library libvulkan.so.1 || missing="libvulkan1"
    [ -n "$found" ] || missing="$missing mesa-vulkan-drivers"
    if have apt-get; then
        # shellcheck disable=SC2086
        newer_mesa || install_with_apt $missing || { complain "could not install:$missing"; return 1; }
        found=$(drivers)
        if [ -n "$found" ] && library libvulkan.so.1; then
            say "Vulkan drivers: $found"
            return 0
        fi
        complain "installed, yet no driver answers. Without one nothing can be drawn."
        return 1
    fi
    complain "no Vulkan driver answers. Install the loader and a driver (Mesa's draws on the CPU if need be), then run this again:"
    complain "  Fedora:   sudo dnf install vulkan-loader mesa-vulkan-drivers"
    complain "  Arch:     sudo pacman -S vulkan-icd-loader vulkan-swrast"
    complain "  openSUSE: sudo zypper install libvulkan1 libvulkan_lvp"
    complain "  Alpine:   sudo apk add vulkan-loader mesa-vulkan-swrast"
    complain "  otherwise the driver of your graphics card, and libvulkan.so.1"
    return 1
}

check_rust() {
    if have cargo; then return 0; fi
    if [ -x "${CARGO_HOME:-${HOME:-/root}/.cargo}/bin/cargo" ]; then
        complain "cargo is installed but not on the PATH. Run: . \"${CARGO_HOME:-$HOME/.cargo}/env\""
    else
        complain "cargo is missing. Install Rust from https://rustup.rs"
    fi
    return 1
}

check_linker() {
    if have cc || have gcc || have clang; then return 0; fi
    case $(uname -s) in
        Darwin) complain "a C linker is missing. Run: xcode-select --install" ;;
        MINGW* | MSYS* | CYGWIN*) return 0 ;;
        *)
            complain "a C linker is missing. Install gcc and the C library's headers (Debian and Ubuntu: sudo apt-get install gcc libc6-dev)"
            ;;
    esac
    return 1
}

# FLIP, in `lucerna compare`, is C++.
check_cxx() {
    # shellcheck disable=SC2086
    if [ -n "${CXX:-}" ] && have ${CXX%% *}; then return 0; fi
    if have c++ || have g++ || have clang++; then return 0; fi
    case $(uname -s) in
        Darwin) complain "a C++ compiler is missing. Run: xcode-select --install" ;;
        MINGW* | MSYS* | CYGWIN*) return 0 ;;
        *)
            if have apt-get && install_with_apt g++ && have g++; then
                say "C++ compiler: g++"
                return 0
            fi
            complain "a C++ compiler is missing. Install one (Debian and Ubuntu: sudo apt-get install g++, elsewhere gcc-c++ or gcc)"
            ;;
    esac
    complain "without one, all but FLIP can be built: cargo build --release --no-default-features"
    return 1
}

# The window is tested on a display of its own.
check_xvfb() {
    case $(uname -s) in
        Linux) ;;
        *) return 0 ;;
    esac
    if have Xvfb; then return 0; fi
    if have apt-get && install_with_apt xvfb && have Xvfb; then
        say "X server for tests: Xvfb"
        return 0
    fi
    complain "Xvfb is missing, on which the window is tested. Install it:"
    complain "  Debian, Ubuntu: sudo apt-get install xvfb"
    complain "  Fedora:         sudo dnf install xorg-x11-server-Xvfb"
    complain "  Arch:           sudo pacman -S xorg-server-xvfb"
    complain "  openSUSE:       sudo zypper install xorg-x11-server-Xvfb"
    complain "  Alpine:         sudo apk add xvfb"
    return 1
}

# The page of a family of scenes is tested in a browser.
check_chromium() {
    if have chromium || have chromium-browser || have google-chrome || have google-chrome-stable; then return 0; fi
    if have apt-get && install_with_apt chromium && have chromium; then
        say "browser for tests: Chromium"
        return 0
    fi
    complain "Chromium is missing, in which pages are tested. Install it:"
    complain "  Debian:         sudo apt-get install chromium"
    complain "  Ubuntu:         sudo snap install chromium"
    complain "  Fedora:         sudo dnf install chromium"
    complain "  Arch:           sudo pacman -S chromium"
    complain "  openSUSE:       sudo zypper install chromium"
    complain "  Alpine:         sudo apk add chromium"
    complain "  macOS, Windows: https://www.google.com/chrome, as google-chrome on the PATH"
    return 1
}

tests=no
release_mesa=no
for argument in "$@"; do
    case $argument in
        --tests) tests=yes ;;
        --release-mesa) release_mesa=yes ;;
        *)
            complain "unknown argument $argument; known: --tests, --release-mesa"
            exit 1
            ;;
    esac
done
failed=0
check_driver || failed=1
check_rust || failed=1
check_linker || failed=1
check_cxx || failed=1
if [ "$tests" = yes ]; then
    check_xvfb || failed=1
    check_chromium || failed=1
fi
if [ "$failed" -eq 0 ]; then say "ready"; fi
exit "$failed"
