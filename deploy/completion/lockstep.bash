# Completion of the lockstep command for bash. It reads verbs and options from the command's --help, so that they match
# the installed version.

# Prints the verbs, or the parts of a verb, that a help text lists.
_lockstep_verbs() { awk '/^Verbs.*:$/ { on = 1; next } /^[^ ]/ { on = 0 } on && /^  [a-z]/ { print $1 }' <<<"$1"; }

_lockstep_options() { grep -oE '^  (-[A-Za-z],)?--[a-z][a-z-]*' <<<"$1" | grep -oE -- '--[a-z-]+'; }

_lockstep() {
    local command=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} help verbs before
    local -a path=()
    help=$("$command" --help 2>/dev/null)
    verbs=$(_lockstep_verbs "$help")
    for before in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
        grep -qxF -- "$before" <<<"$verbs" || continue
        path+=("$before")
        help=$("$command" "${path[@]}" --help 2>/dev/null)
        verbs=$(_lockstep_verbs "$help")
    done
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_lockstep_options "$help")" -- "$word")
    elif [[ -n $verbs ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$verbs" -- "$word")
    else
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        compopt -o filenames 2>/dev/null
    fi
}
complete -F _lockstep lockstep
