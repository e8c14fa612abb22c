import QtQuick
import Nearfield

// The item draws below everything else; Qt Quick's own items are on top.
Contacts {
    id: contacts

    Rectangle {
        anchors { left: parent.left; bottom: parent.bottom; margins: 12 }
        width: label.width + 24
        height: label.height + 16
        radius: 8
        color: "#c0303644"

        Text {
            id: label
            anchors.centerIn: parent
            color: "#e8e8ee"
            font.pixelSize: 15
            text: contacts.count + " contacts"
        }
    }
}
