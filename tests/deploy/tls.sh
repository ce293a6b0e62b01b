# Sourced: certificates for tests.

# make_certificates FOLDER: an authority, a server's certificate for localhost and the names it is
# called in these tests, and a client's; PEM files, new ones at each call but for the authority's.
make_certificates() {
  local folder=$1
  mkdir -p "$folder"
  (
    cd "$folder"
    if [ ! -e ca.pem ]; then
      openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 30 -subj "/CN=test authority" \
        -addext basicConstraints=critical,CA:TRUE,pathlen:0 -keyout ca.key -out ca.pem
    fi
    issue() { # name, usage, subject alternative names
      openssl req -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -subj "/CN=$1" \
        -keyout "$1.key.new" -out "$1.csr"
      openssl x509 -req -in "$1.csr" -CA ca.pem -CAkey ca.key -CAcreateserial -days 30 -out "$1.pem.new" \
        -extfile <(printf 'extendedKeyUsage=%s\nsubjectAltName=%s\n' "$2" "$3")
      mv "$1.key.new" "$1.key"
      mv "$1.pem.new" "$1.pem"
    }
    issue server serverAuth "DNS:localhost,DNS:trcd,IP:127.0.0.1"
    issue client clientAuth "URI:spiffe://plant/press"
  ) >"$folder/log" 2>&1 || fail "no certificates: $(tail -1 "$folder/log")"
}
