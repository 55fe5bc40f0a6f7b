# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
#
# complete.zsh FOLDER TEXT: prints the line that zsh makes of TEXT and a tab, with the completions in FOLDER.
zmodload zsh/zpty
zpty shell "PS1='' zsh -f -i"
zpty -w shell "fpath=(${(q)1} \$fpath); autoload -Uz compinit; compinit -u -D; bindkey '^I' complete-word; echo rea''dy"
zpty -r shell out '*ready*'
zpty -w -n shell "$2"$'\t'
sleep "${3:-1}"
zpty -w -n shell $'\C-e\C-a: \C-e\n' # shown behind a colon, not run
zpty -w shell 'echo en''d'
zpty -r shell out '*end*'
print -r -- ${out//$'\r'/}
zpty -d shell
