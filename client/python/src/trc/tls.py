"""Encrypted connections."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Union

import grpc

File = Union[str, Path]


@dataclass(frozen=True)
class Tls:
    """Certificates, as names of PEM files."""

    ca: Optional[File] = None
    """Who signs the server; none: whom the system trusts."""
    certificate: Optional[File] = None
    """What shows who the client is, with `key`."""
    key: Optional[File] = None

    def credentials(self) -> grpc.ChannelCredentials:
        """For a channel of gRPC."""

        def content(file: Optional[File]) -> Optional[bytes]:
            return None if file is None else Path(file).read_bytes()

        if (self.certificate is None) != (self.key is None):
            raise ValueError("a client certificate and its key belong together")
        return grpc.ssl_channel_credentials(
            content(self.ca), content(self.key), content(self.certificate))
