#!/bin/sh
# `swirl site`: the documentation, the browser page, the gallery and the notebooks as HTML pages in one
# folder, which works from any web server or as local files.
set -eu
home=$(dirname "$(dirname "$(readlink -f "$0")")")
me=swirl
. "$home/cmake/launcher.sh"

usage() {
    cat <<'TEXT'
Write the documentation, the browser page, the gallery and the notebooks as a web site.
Usage: swirl site --out DIR [--report DIR] [--address URL]

Options:
  -h,--help                       Print this help message and exit
  --out DIR                       Output folder; an existing site is replaced
  --report DIR                    Include the report of swirl paper in DIR
  --address URL                   Public address of DIR, for search engines and link previews

Examples:
  swirl site --out site
  swirl paper --out results && swirl site --out site --report results
TEXT
}
out= report= address=
while [ $# -gt 0 ]; do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --out | --report | --address)
            [ $# -gt 1 ] && [ -n "$2" ] || usage_error "$1 needs a value." "see \`swirl site --help\`."
            case $1 in
                --out) out=$2 ;;
                --report) report=$2 ;;
                --address) address=${2%/}/ ;;
            esac
            shift 2
            ;;
        --out=*) out=${1#*=} && shift ;;
        --report=*) report=${1#*=} && shift ;;
        --address=*) address=${1#*=} && address=${address%/}/ && shift ;;
        --)
            [ $# -eq 1 ] || usage_error "unexpected argument '$2'." "see \`swirl site --help\`."
            break
            ;;
        *) usage_error "there is no option '$1'." "see \`swirl site --help\`." ;;
    esac
done
[ -n "$out" ] || usage_error "missing required option --out DIR."
if [ -n "$report" ] && ! [ -e "$report/report.html" ]; then
    usage_error "--report is '$report', but it contains no report.html." "run \`swirl paper\` first."
fi
case $address in
    '' | http://?* | https://?*) ;;
    *) usage_error "--address is '$address', but it must begin with https://." ;;
esac
case $address in
    *[!A-Za-z0-9:/._~-]*) usage_error "--address is '$address', but it may contain only letters, digits and :/._~-." ;;
esac
# Only a folder that this command wrote is replaced.
if [ -e "$out" ] && ! [ -e "$out/.swirl-site" ] && [ -n "$(ls -A "$out" 2>/dev/null || echo no folder)" ]; then
    usage_error "--out is '$out', which is neither empty nor a site." "choose another name."
fi

# The site is built in a temporary folder next to it, which is held meanwhile. After a kill that folder
# remains, and nobody holds it. If the kill came between the two renames at the end, the old site is in it and
# is moved back.
out=${out%"${out##*[!/]}"} # without trailing slashes
for left in "$out".partial.??????; do
    [ -d "$left/notebooks" ] && (try_lock "$left") || continue
    [ -e "$out" ] || ! [ -e "$left/before" ] || rename "$left/before" "$out"
    rm -rf "$left"
done
mkdir -p "$(dirname "$out")" 2>/dev/null &&
    temporary=$(mktemp -d "$out.partial.XXXXXX" 2>/dev/null) || give_up "'$out' cannot be written."
trap 'rm -rf "$temporary"' EXIT
trap 'exit 130' INT
trap 'exit 143' HUP TERM
lock "$temporary" site
site=$temporary/site
source=$temporary/source
log=$temporary/log
mkdir -p "$source" "$temporary/gallery" "$temporary/notebooks" "$site"
install_packages site || exit 1
program=${SWIRL-$home/swirl}
install_packages images movies || true # the gallery omits what cannot be made
# shellcheck disable=SC2016
sed -n '/ | docs\//!s/^[^#].* | swirl //p' "$home/web/gallery.txt" "$home/web/tiles.txt" | (
    cd "$temporary/gallery"
    while read -r made; do
        # The commands in this file contain no quotes.
        # shellcheck disable=SC2086
        "$program" $made --quiet 2>/dev/null || say "warning: the gallery omits: swirl $made"
    done
    # What a page shows of a movie before it is loaded.
    for movie in *.mp4; do
        [ ! -e "$movie" ] || ffmpeg -v error -i "$movie" -frames:v 1 -q:v 5 "${movie%.mp4}.jpg" </dev/null
    done
)
python=${SWIRL_PYTHON-$home/bindings/python/python.sh}
# The first call builds the module if necessary, and reports that.
if ! install_packages notebooks || ! "$python" -P -c "import swirl, nbclient"; then
    say "warning: the notebooks are shown without output."
elif ! "$python" "$home/web/notebooks.py" "$temporary/notebooks" "$home"/examples/*.ipynb 2>"$log"; then
    tail -n 5 "$log" >&2
    give_up "the notebooks of examples/ could not be executed (see above)."
fi
# Other versions of Sphinx and of its theme make other pages, so Debian's are used.
if ! "$(system_python)" -B "$home/web/site.py" "$home" "$source" "$temporary/gallery" "$temporary/notebooks" >"$log" 2>&1 ||
    ! SWIRL_SITE_ADDRESS=$address sphinx-build -q -W --keep-going -c "$source/docs" -d "$temporary/doctrees" "$source" "$site" >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    give_up "the site could not be built (see above)."
fi
"$home/web/lab.sh" --quiet --out "$temporary/pages/"
# The pages link to the documentation next to them. Search engines and link previews need their public address.
# A link to the first page from the time when there was one page only is lab.html.
[ -z "$address" ] || cp "$home/docs/images/lab_preview.png" "$site/preview.png"
for page in index:lab laboratory:laboratory; do
    name=${page#*:}.html
    head='<meta name="swirl-documentation" content="docs/">'
    if [ -n "$address" ]; then
        head="$head<link rel=\"canonical\" href=\"$address$name\"><meta property=\"og:url\" content=\"$address$name\">"
        head="$head<meta property=\"og:image\" content=\"${address}preview.png\"><meta name=\"twitter:card\" content=\"summary_large_image\">"
    fi
    sed "s|<meta charset=\"utf-8\">|&$head|; s|href=\"index.html\"|href=\"lab.html\"|" "$temporary/pages/${page%:*}.html" >"$site/$name"
done
# Sphinx copies the images of the pages, but no movies.
for movie in "$temporary"/gallery/*.mp4 "$temporary"/gallery/*.jpg; do
    [ ! -e "$movie" ] || { mkdir -p "$site/gallery" && cp "$movie" "$site/gallery"; }
done
[ -z "$report" ] || cp -R "$report" "$site/report"
canonical=
[ -z "$address" ] || canonical="<link rel=\"canonical\" href=\"${address}docs/index.html\">"
[ -e "$site/index.html" ] || cat >"$site/index.html" <<HTML
<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>swirl: why marbles in a swirled dish turn backwards</title>
<meta name="description" content="A few marbles in a swirled dish turn with the swirl, many against it. A live simulation, and its documentation.">
<meta http-equiv="refresh" content="0; url=docs/index.html">
$canonical
<a href="docs/index.html">Documentation</a>
</html>
HTML
if [ -n "$address" ]; then
    (cd "$site" && find . -name '*.html' | LC_ALL=C sort | sed "s|^\./|$address|") >"$site/sitemap.txt"
    echo "Sitemap: ${address}sitemap.txt" >"$site/robots.txt"
fi
pages=$(find "$site" -name '*.html' | wc -l)
touch "$site/.swirl-site"
trap '' INT HUP TERM # both renames or none
if [ -e "$out" ]; then
    rename "$out" "$temporary/before" || give_up "'$out' cannot be replaced."
fi
rename "$site" "$out" || {
    ! [ -e "$temporary/before" ] || rename "$temporary/before" "$out"
    give_up "'$out' cannot be written."
}
say "wrote $out/index.html ($pages pages)"
