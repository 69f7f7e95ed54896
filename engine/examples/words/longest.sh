# The longest words of counts, one a line: longest.sh COUNTS.csv OUT MOST
set -e
tail -n +2 "$1" | cut -d, -f2 | sort -u | awk '{ print length($0), $0 }' | sort -k1,1nr -k2 | head -n "$3" > "$2"
