"""Messages of stages: a sentence, and for programs its code and fields."""

import json
from typing import Any, Dict, Union


class Message(str):
    """A sentence; ``str`` in all it does.

    Attributes
    ----------
    code : str
        What kind of message it is, such as ``"warn-same-file"``; empty for a sentence as somebody gave it.
    fields : dict
        What the sentence holds, by name: numbers as ``{"value": 2.8, "digits": 1, "unit": "%"}``, names, lists,
        messages in messages.
    """

    code: str
    fields: Dict[str, Any]

    def __new__(cls, written: Union[str, Dict[str, Any]], place: str = "") -> "Message":
        """Of a message as records and answers have it; ``place`` is written before it."""
        if isinstance(written, str):
            written = {"text": written}
        message = super().__new__(cls, place + written["text"])
        message.code = written.get("code", "")
        message.fields = written.get("fields", {})
        return message

    @classmethod
    def of_json(cls, text: str) -> "Message":
        """Of a message in JSON."""
        return cls(json.loads(text))
