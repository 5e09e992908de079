# Compares temperatures that CalculiX printed at the nodes of a part with those at the same places of the
# whole:
#
#   awk -f same-temperatures.awk part.inp part.dat whole.inp whole.dat
#
# Fails if a node is missing, or if temperatures differ by more than 1e-5 of the highest.

FNR == 1 { file++; nodes = 0 }

file % 2 == 1 && /^\*/ { nodes = /^\*NODE,/; next }
file % 2 == 1 && nodes {
    split($0, word, /, */)
    place[file, word[1]] = rounded(word[2]) " " rounded(word[3]) " " rounded(word[4])
}

file % 2 == 0 && NF == 2 && $1 ~ /^[0-9]+$/ {
    at = place[file - 1, $1]
    if (file == 2) {
        temperature[at] = $2
        count++
    } else {
        total++
        if ($2 + 0 > highest) highest = $2 + 0
        if (at in temperature) {
            found++
            difference = temperature[at] - $2
            if (difference < 0) difference = -difference
            if (difference > largest) largest = difference
        }
    }
}

END {
    printf "%d nodes of the part, %d of the whole, highest temperature %g\n", count, total, highest
    printf "temperatures differ by at most %.1e of it\n", (highest > 0) ? largest / highest : 0
    if (found != count || count == 0) {
        printf "%d nodes of the part are none of the whole\n", count - found > "/dev/stderr"
        exit 1
    }
    if (!(highest > 0 && largest <= 1e-5 * highest)) {
        print "that is too much" > "/dev/stderr"
        exit 1
    }
}

function rounded(x,    text) {
    text = sprintf("%.7f", x)
    return text == "-0.0000000" ? "0.0000000" : text
}
