# Sourced by run and test: makes and updates .venv, the checkout's own Python environment.

say() { echo "modeviz: $*" >&2; }

fail() {
    say "$*"
    exit 1
}

# Prints the first interpreter that runs and is new enough; a version manager's shim may do neither.
find_python() {
    local name
    for name in python3 python python3.14 python3.13 python3.12 python3.11; do
        if "$name" -c "import sys; sys.exit(sys.version_info < (3, 11))" 2>/dev/null; then
            echo "$name"
            return
        fi
    done
    fail "found $(python3 --version 2>/dev/null || echo no Python), expected Python 3.11 or newer"
}

# What an installation depends on: it is out of date in a moved checkout or under another Python.
fingerprint() {
    pwd
    .venv/bin/python --version 2>/dev/null || true
    cat pyproject.toml
}

# up_to_date STAMP: whether the installation that left that stamp still holds.
up_to_date() { [ "$(cat ".venv/$1" 2>/dev/null)" = "$(fingerprint)" ]; }

# pip_install REQUIREMENT: installs it in .venv, making that first if it is missing or broken.
pip_install() {
    local python
    if ! .venv/bin/python -m pip --version >/dev/null 2>&1; then
        python="$(find_python)"
        "$python" -m venv --clear .venv >&2 ||
            fail "$python cannot make an environment; on Debian and Ubuntu: apt install python3-venv"
    fi
    # Compiling what is never imported would take longer than all the rest.
    .venv/bin/python -m pip install --quiet --disable-pip-version-check --no-compile \
        --editable "$1" >&2 ||
        fail "pip could not install modeviz, see above"
}
