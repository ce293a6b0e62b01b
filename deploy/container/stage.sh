#!/bin/sh
# stage.sh BUILD STAGE: puts the programs of a build, the libraries they load and what belongs to
# these into a new folder that can serve as the root of a container.
#
# Nothing of the target is run, so that it works for a cross build too: the libraries are found by
# what the ELF files name. A list of the Debian packages comes with them in two forms:
# /usr/share/doc/trcd/sbom.cdx.json (CycloneDX), and /var/lib/dpkg/status.d, where scanners of
# images without dpkg look.
set -eu

build=$1
stage=$2
here=$(dirname "$(readlink -f "$0")")
machine=$(readelf -h "$build/bin/trcd" | sed -n 's/^ *Machine: *//p')
case $machine in
  *X86-64) triplet=x86_64-linux-gnu architecture=amd64 loader=lib64 strip=strip ;;
  AArch64) triplet=aarch64-linux-gnu architecture=arm64 loader=lib strip=aarch64-linux-gnu-strip ;;
  *) echo "error: no rule for $machine" >&2; exit 1 ;;
esac
libraries=usr/lib/$triplet

# Empty folders where engines mount something, and links as Debian has them.
for folder in usr/bin usr/lib usr/lib64 "$libraries" usr/share/doc/trcd etc var/lib/dpkg/status.d \
  dev proc sys run tmp home; do
  mkdir -p "$stage/$folder"
done
chmod 1777 "$stage/tmp"
# A volume here begins with this owner, so that the server can keep its key in it.
install -d -o 65532 -g 65532 -m 700 "$stage/var/lib/trcd"
ln -s usr/lib "$stage/lib"
ln -s usr/lib64 "$stage/lib64"
ln -s usr/bin "$stage/bin"

for program in trc trcd; do
  cp "$build/bin/$program" "$stage/usr/bin/"
  "$strip" --strip-unneeded "$stage/usr/bin/$program"
done

# Breadth first over what is named as needed.
needed_by() { readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'; }
waiting="$stage/usr/bin/trc $stage/usr/bin/trcd"
: >"$stage/../staged_libraries"
while [ -n "$waiting" ]; do
  next=
  for file in $waiting; do
    for name in $(needed_by "$file"); do
      [ ! -e "$stage/$libraries/$name" ] || continue
      cp -L "/$libraries/$name" "$stage/$libraries/$name"
      echo "$name" >>"$stage/../staged_libraries"
      next="$next $stage/$libraries/$name"
    done
  done
  waiting=$next
done
interpreter=$(readelf -l "$stage/usr/bin/trcd" | sed -n 's/.*interpreter: \(.*\)\]/\1/p')
[ -e "$stage/$libraries/$(basename "$interpreter")" ] ||
  cp -L "/$libraries/$(basename "$interpreter")" "$stage/$libraries/"
ln -s "../../$libraries/$(basename "$interpreter")" "$stage/usr/$loader/$(basename "$interpreter")"

cat >"$stage/etc/passwd" <<'TEXT'
root:x:0:0:root:/:/none
trcd:x:65532:65532:trcd:/:/none
TEXT
cat >"$stage/etc/group" <<'TEXT'
root:x:0:
trcd:x:65532:
TEXT
echo 'hosts: files dns' >"$stage/etc/nsswitch.conf"
cp -L /etc/os-release "$stage/etc/os-release"
: >"$stage/etc/resolv.conf"
: >"$stage/etc/hosts"
: >"$stage/etc/hostname"
cp "$here/../../LICENSE" "$stage/usr/share/doc/trcd/copyright"

# The package a file came with; dpkg knows the files of /usr/lib partly as those of /lib.
package_of() {
  dpkg-query -S "$1" 2>/dev/null || dpkg-query -S "${1#/usr}" 2>/dev/null
}
loaded=$(while read -r name; do
  package_of "$(readlink -f "/$libraries/$name")" ||
    { echo "error: no package owns $name" >&2; exit 1; }
done <"$stage/../staged_libraries" | sed 's/: .*//' | sort -u)
rm "$stage/../staged_libraries"

# Headers are compiled in: their packages belong to the list as well, the libraries' own ones too.
compiled=$(ninja -C "$build" -t deps | sed -n 's,^ *\(/usr/include/.*\|/usr/lib/gcc.*\)$,\1,p' |
  sort -u | xargs -r dpkg-query -S 2>/dev/null | sed 's/: .*//' | tr -d ' ' | tr ',' '\n' | sort -u)

for package in $loaded; do
  name=${package%%:*}
  mkdir -p "$stage/usr/share/doc/$name"
  cp -L "/usr/share/doc/$name/copyright" "$stage/usr/share/doc/$name/copyright"
  dpkg-query -s "$package" >"$stage/var/lib/dpkg/status.d/$name"
done
version=$(sed -n 's/^project(trc VERSION \([0-9.]*\).*/\1/p' "$here/../../CMakeLists.txt")
"$here/sbom.sh" "$version" "$architecture" "$loaded" "$compiled" \
  >"$stage/usr/share/doc/trcd/sbom.cdx.json"

find "$stage" -exec touch --no-dereference --date="@${SOURCE_DATE_EPOCH:-0}" {} +
