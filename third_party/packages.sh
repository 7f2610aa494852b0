# Sourced by `play` and `check`: installs the packages of packages.txt that are missing.

# stop NAME MESSAGE: one line, and the end.
stop() {
    echo "$1: $2" >&2
    exit 1
}

# install_missing NAME KIND...: NAME goes before messages. Does nothing, and needs no network, when all is there.
install_missing() {
    local name=$1 list kind package missing=()
    shift
    list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"
    if ! command -v dpkg-query >/dev/null; then
        echo "$name: no dpkg here, so what $list lists is taken to be installed" >&2
        return
    fi
    while read -r kind package; do
        [[ " $* " == *" $kind "* ]] || continue
        [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || missing+=("$package")
    done <"$list"
    ((${#missing[@]})) || return 0

    command -v apt-get >/dev/null || stop "$name" "no apt-get here to install: ${missing[*]}"
    local root=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null || stop "$name" "needs root or sudo to install: ${missing[*]}"
        root=(sudo)
    fi
    echo "$name: installing ${missing[*]}"
    local log
    log=$(mktemp)
    local apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y)
    if ! "${apt[@]}" update </dev/null >"$log" 2>&1 ||
        ! "${apt[@]}" install --no-install-recommends "${missing[@]}" </dev/null >>"$log" 2>&1; then
        local reason
        reason=$(grep '^E: ' "$log" | tail -n 1) || true
        reason=${reason:-$(tail -n 1 "$log")}
        rm -f "$log"
        stop "$name" "apt-get cannot install ${missing[*]}: ${reason#E: }"
    fi
    rm -f "$log"
}
