#!/bin/sh
# Makes sure that Lucerna can build and draw here: a Rust toolchain, a C linker, a C++ compiler, and a graphics driver that
# wgpu can use.
#
#   sh setup.sh           # to build and draw
#   sh setup.sh --tests   # to run the tests as well: on Linux, also an X server without a screen (Xvfb), for the window
#
# Where a driver is there already, and on macOS (Metal) and Windows (DirectX 12), nothing is installed. On Debian and
# Ubuntu without one, the Vulkan loader and Mesa's drivers are, which draw on the CPU if need be; and g++ without a compiler. Running it again is quick
# and changes nothing. Exits with 0 if all is there, else with 1, and says what to do.
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

check_driver() {
    case $(uname -s) in
        Darwin) say "graphics: Metal is part of macOS"; return 0 ;;
        MINGW* | MSYS* | CYGWIN*) say "graphics: DirectX 12 is part of Windows"; return 0 ;;
    esac
    found=$(drivers)
    if [ -n "$found" ] && library libvulkan.so.1; then
        say "Vulkan drivers: $found"
        return 0
    fi
    missing=
    library libvulkan.so.1 || missing="libvulkan1"
    [ -n "$found" ] || missing="$missing mesa-vulkan-drivers"
    if have apt-get; then
        # shellcheck disable=SC2086
        install_with_apt $missing || { complain "could not install:$missing"; return 1; }
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

for argument in "$@"; do
    if [ "$argument" != --tests ]; then
        complain "unknown argument $argument; known: --tests"
        exit 1
    fi
done
failed=0
check_driver || failed=1
check_rust || failed=1
check_linker || failed=1
check_cxx || failed=1
case ${1:-} in
    --tests) check_xvfb || failed=1 ;;
esac
if [ "$failed" -eq 0 ]; then say "ready"; fi
exit "$failed"
