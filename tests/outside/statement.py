"""The libraries of DSSE and in-toto read an envelope and its statement: statement.py STATEMENT ENVELOPE KEY.pem"""

import json
import sys
from pathlib import Path

import in_toto_attestation.v1.statement_pb2 as statement_pb2
from cryptography.hazmat.primitives.serialization import load_pem_public_key
from google.protobuf import json_format
from in_toto_attestation.v1.statement import Statement
from securesystemslib.dsse import Envelope
from securesystemslib.signer import SSlibKey

statement, envelope, pem = (Path(path).read_bytes() for path in sys.argv[1:])
parsed = Envelope.from_dict(json.loads(envelope))
(keyid,) = parsed.signatures
parsed.verify([SSlibKey.from_crypto(load_pem_public_key(pem), keyid=keyid)], 1)
assert parsed.payload == statement, "the payload is not the statement"
Statement.copy_from_pb(json_format.Parse(statement, statement_pb2.Statement())).validate()
