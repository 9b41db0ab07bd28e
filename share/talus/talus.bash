# SPDX-License-Identifier: LGPL-2.1-or-later
# Completion of talus for bash.
_talus()
{
  local word=${COMP_WORDS[COMP_CWORD]}
  case ${COMP_WORDS[COMP_CWORD-1]} in
    --set|--output)
      mapfile -t COMPREPLY < <(compgen -d -- "$word")
      return ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W '--set --output --resume --overwrite --validate
      --document --version --help' -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -X '!*.prm' -- "$word"; compgen -d -- "$word")
  fi
}
complete -o filenames -F _talus talus
