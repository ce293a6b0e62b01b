#!/bin/sh
# sbom.sh VERSION ARCHITECTURE LOADED COMPILED: the bill of materials of an image with trcd, as
# CycloneDX 1.5 JSON. LOADED are the Debian packages whose libraries are in the image, COMPILED those
# whose headers went into the programs; both as installed here. No time and no number of its own:
# equal contents give equal bytes.
set -eu
version=$1
architecture=$2
loaded=$3
compiled=$4

list() { # linkage, packages
  # shellcheck disable=SC2086  # a list of names
  [ -z "$2" ] || dpkg-query -W -f="$1"'\t${Package}\t${Version}\t${Architecture}\t${source:Package}\t${source:Version}\n' $2
}

{ list loaded "$loaded"; list compiled "$compiled"; } | sort -u -t '	' -k 2,4 -k 1,1r |
  awk -F '\t' -v version="$version" -v architecture="$architecture" '
    function quoted(text) { gsub(/[\\"]/, "\\\\&", text); return "\"" text "\"" }
    # What may stand in a package URL as it is: letters, digits and -._~
    function encoded(text) { gsub(/%/, "%25", text); gsub(/\+/, "%2B", text); gsub(/:/, "%3A", text); return text }
    function purl(name, ver, arch) {
      return "pkg:deb/debian/" encoded(name) "@" encoded(ver) "?arch=" arch "&distro=debian-12"
    }
    BEGIN {
      print "{"
      print "  \"bomFormat\": \"CycloneDX\","
      print "  \"specVersion\": \"1.5\","
      print "  \"version\": 1,"
      print "  \"metadata\": {"
      print "    \"component\": {"
      print "      \"type\": \"application\", \"bom-ref\": \"trcd\", \"name\": \"trcd\","
      print "      \"version\": " quoted(version) ","
      print "      \"licenses\": [{\"license\": {\"id\": \"MIT\"}}],"
      print "      \"properties\": [{\"name\": \"trc:architecture\", \"value\": " quoted(architecture) "}]"
      print "    }"
      print "  },"
      print "  \"components\": ["
    }
    {
      reference = purl($2, $3, $4)
      if (reference in seen) next
      seen[reference] = 1
      printf "%s    {\"type\": \"library\", \"bom-ref\": %s, \"name\": %s, \"version\": %s, \"purl\": %s,\n",
        (NR > 1 ? ",\n" : ""), quoted(reference), quoted($2), quoted($3), quoted(reference)
      printf "     \"properties\": [{\"name\": \"trc:use\", \"value\": %s}, {\"name\": \"debian:source\", \"value\": %s}]}",
        quoted($1), quoted($5 " " $6)
    }
    END { print "\n  ]\n}" }'
