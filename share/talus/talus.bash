# SPDX-License-Identifier: LGPL-2.1-or-later
# Completion of talus and of the tools for bash.
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

# Options of the tools by name; $1 is the command. Behind the options come folders of
# runs, and parameter files where a tool reads one.
_talus_tool()
{
  local word=${COMP_WORDS[COMP_CWORD]} options='' reads_file=''
  case ${1##*/} in
    talus-animate) options='--output --fps --most' ;;
    talus-calibrate) options='--output --program' reads_file=yes ;;
    talus-compare) options='--output' ;;
    talus-pipe) options='--output' reads_file=yes ;;
    talus-report) options='--slab --weak-layer' ;;
    talus-tsunami)
      options='--interval --start-time --width --water-depth --degrees --netcdf --output' ;;
    talus-study) options='--output --program --at-once --list --member --collect' reads_file=yes ;;
  esac
  COMPREPLY=()
  case ${COMP_WORDS[COMP_CWORD-1]} in
    --output|--program)
      mapfile -t COMPREPLY < <(compgen -f -- "$word")
      return ;;
    # Numbers, and names of bodies.
    --fps|--most|--at-once|--member|--slab|--weak-layer|--interval|--start-time|--width|--water-depth)
      return ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options --help" -- "$word")
    return
  fi
  mapfile -t COMPREPLY < <(compgen -d -- "$word")
  if [[ $reads_file ]]; then
    mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -X '!*.prm' -- "$word")
  fi
}
complete -o filenames -F _talus_tool talus-animate talus-calibrate talus-compare \
  talus-pipe talus-report talus-study talus-tsunami
