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
    talus-new) options='--name --output --cells --cell-size --sides --reach --strength-ratio
      --strength-at-mudline --sensitivity --bed-shear-stress --density --water-density'
      reads_file=any ;;
    talus-pipe) options='--output' reads_file=yes ;;
    talus-report) options='--slab --weak-layer' ;;
    talus-screen) options='--depths --strength --horizontal --density --water-density --length
      --output' reads_file=any ;;
    talus-tsunami)
      options='--interval --start-time --width --water-depth --degrees --netcdf --geoclaw
        --sea-level --output' ;;
    talus-study) options='--output --program --at-once --list --member --collect' reads_file=yes ;;
  esac
  COMPREPLY=()
  case ${COMP_WORDS[COMP_CWORD-1]} in
    --output|--program)
      mapfile -t COMPREPLY < <(compgen -f -- "$word")
      return ;;
    # Numbers, and names.
    --fps|--most|--at-once|--member|--slab|--weak-layer|--interval|--start-time|--width|--water-depth|\
      --name|--cells|--cell-size|--sides|--reach|--strength-ratio|--strength-at-mudline|\
      --sensitivity|--bed-shear-stress|--density|--water-density|--depths|--strength|\
      --horizontal|--length)
      return ;;
  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options --help" -- "$word")
    return
  fi
  mapfile -t COMPREPLY < <(compgen -d -- "$word")
  case $reads_file in
    any) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    yes) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -X '!*.prm' -- "$word") ;;
  esac
}
complete -o filenames -F _talus_tool talus-animate talus-calibrate talus-compare \
  talus-new talus-pipe talus-report talus-screen talus-study talus-tsunami
