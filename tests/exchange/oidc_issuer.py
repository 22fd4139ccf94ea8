"""A provider by a script: it signs what no proper one would, and holds PKCE as RFC 7636 says.

It shares no code with the program: tokens are put together by hand (RFC 7515) and signed by
`cryptography`; sockets are those of `lrs_server`.
"""

import base64
import hashlib
import hmac
import json
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlencode, urlsplit

from cryptography.hazmat.primitives.asymmetric import ec, ed25519, padding, rsa
from cryptography.hazmat.primitives.asymmetric.utils import decode_dss_signature
from cryptography.hazmat.primitives.hashes import SHA256
from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat

CODE = "a-code"
RSA, SMALL = (rsa.generate_private_key(65537, bits) for bits in (2048, 1024))
OTHER = rsa.generate_private_key(65537, 2048)
CURVE, EDWARDS = ec.generate_private_key(ec.SECP256R1()), ed25519.Ed25519PrivateKey.generate()


def b64(data):
    return base64.urlsafe_b64encode(data).rstrip(b"=").decode()


def number(value):
    return b64(value.to_bytes((value.bit_length() + 7) // 8, "big"))


def jwk(private, kid="k", **more):
    public = private.public_key()
    if isinstance(public, rsa.RSAPublicKey):
        of = public.public_numbers()
        key = {"kty": "RSA", "n": number(of.n), "e": number(of.e)}
    elif isinstance(public, ec.EllipticCurvePublicKey):
        of = public.public_numbers()
        xy = (b64(value.to_bytes(32, "big")) for value in (of.x, of.y))
        key = {"kty": "EC", "crv": "P-256"} | dict(zip("xy", xy, strict=True))
    else:
        key = {"kty": "OKP", "crv": "Ed25519", "x": b64(public.public_bytes_raw())}
    return key | {"kid": kid, "use": "sig"} | more


def pem(private):
    kind = PublicFormat.SubjectPublicKeyInfo
    return private.public_key().public_bytes(Encoding.PEM, kind)


def signed(claims, private, alg="RS256", **head):
    """Return a compact token; `private` is a key, or the secret of HS256."""
    header = {"alg": alg, "typ": "JWT", "kid": "k"} | head
    header = {name: value for name, value in header.items() if value is not None}
    text = f"{b64(json.dumps(header).encode())}.{b64(json.dumps(claims).encode())}"
    raw = text.encode()
    if alg == "none":
        signature = b""
    elif alg == "HS256":
        signature = hmac.digest(private, raw, "sha256")
    elif isinstance(private, rsa.RSAPrivateKey):
        signature = private.sign(raw, padding.PKCS1v15(), SHA256())
    elif isinstance(private, ec.EllipticCurvePrivateKey):
        r, s = decode_dss_signature(private.sign(raw, ec.ECDSA(SHA256())))
        signature = r.to_bytes(32, "big") + s.to_bytes(32, "big")
    else:
        signature = private.sign(raw)
    return f"{text}.{b64(signature)}"


class Issuer:
    """A provider of one client, `acus`.

    Attributes:
        document: changes of the discovery document; None takes a field out.
        keys: what it publishes.
        claims: changes of the ID token's claims; None takes one out.
        token: makes the ID token of its claims.
        reply: changes of the answer in the browser; None takes a field out.
        faults: raw answers by path instead of the proper ones: bytes, or a function of a link.
        asked: what the browser asked last.
        redeemed: forms of the token endpoint.
    """

    client = "acus"

    def __init__(self):
        self.document, self.claims, self.reply, self.faults = {}, {}, {}, {}
        self.keys, self.token = [jwk(RSA)], lambda claims: signed(claims, RSA)
        self.asked, self.redeemed, self.paths = {}, [], []

    def __enter__(self):
        issuer = self

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self):
                issuer._answer(self, b"")

            def do_POST(self):
                issuer._answer(self, self.rfile.read(int(self.headers["Content-Length"])))

            def log_message(self, *_):
                pass

        self._server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self._server.daemon_threads, self._server.block_on_close = True, False
        self._server.handle_error = lambda *_: None
        self.over = threading.Event()
        threading.Thread(target=self._server.serve_forever, args=(0.02,), daemon=True).start()
        self.issuer = f"http://127.0.0.1:{self._server.server_port}"
        return self

    def __exit__(self, *_):
        self.over.set()
        self._server.shutdown()
        self._server.server_close()

    def browser(self, address):
        """Return where a browser ends that opens the page: the answer to the program."""
        self.asked = {name: values[0] for name, values in parse_qs(urlsplit(address).query).items()}
        fields = {"code": CODE, "state": self.asked["state"]} | self.reply
        fields = {name: value for name, value in fields.items() if value is not None}
        return f"{self.asked['redirect_uri']}?{urlencode(fields)}"

    def _answer(self, link, body):
        path = urlsplit(link.path).path
        self.paths.append(path)
        fault = self.faults.get(path)
        if fault is not None:
            link.wfile.write(fault) if isinstance(fault, bytes) else fault(link)
            link.close_connection = True
        elif path == "/.well-known/openid-configuration":
            self._send(link, 200, self._changed(self._discovery(), self.document))
        elif path == "/keys":
            self._send(link, 200, {"keys": self.keys})
        elif path == "/token":
            self._redeem(link, {k: v[0] for k, v in parse_qs(body.decode()).items()})
        else:
            self._send(link, 404, {})

    def _discovery(self):
        return {
            "issuer": self.issuer,
            "authorization_endpoint": f"{self.issuer}/authorize",
            "token_endpoint": f"{self.issuer}/token",
            "jwks_uri": f"{self.issuer}/keys",
            "response_types_supported": ["code"],
            "id_token_signing_alg_values_supported": ["RS256", "ES256"],
            "code_challenge_methods_supported": ["S256"],
        }

    def _redeem(self, link, form):
        self.redeemed.append(form)
        digest = b64(hashlib.sha256(form.get("code_verifier", "").encode()).digest())
        right = (
            form.get("grant_type") == "authorization_code"
            and form.get("code") == CODE
            and form.get("client_id") == self.client == self.asked.get("client_id")
            and form.get("redirect_uri") == self.asked.get("redirect_uri")
            and self.asked.get("code_challenge_method") == "S256"
            and digest == self.asked.get("code_challenge")
        )
        if not right:
            self._send(link, 400, {"error": "invalid_grant", "error_description": "Ada Lovelace"})
            return
        now = int(time.time())
        claims = {
            "iss": self.issuer, "sub": "sub-of-ada", "aud": self.client, "exp": now + 300,
            "iat": now, "nonce": self.asked.get("nonce"), "name": "Ada Lovelace",
            "email": "ada@hospital.example",
        }  # fmt: skip
        token = self.token(self._changed(claims, self.claims))
        self._send(link, 200, {"access_token": "x", "token_type": "Bearer", "id_token": token})

    @staticmethod
    def _changed(proper, changes):
        every = proper | changes
        return {name: value for name, value in every.items() if value is not None}

    @staticmethod
    def _send(link, status, document):
        raw = json.dumps(document).encode()
        link.send_response(status)
        link.send_header("Content-Type", "application/json")
        link.send_header("Content-Length", str(len(raw)))
        link.end_headers()
        link.wfile.write(raw)
